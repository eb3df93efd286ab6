#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace nacre {

// `gives_up` is asked some twenty times a second while nothing happens; empty: never.

/// Sends one frame; false if the other end is gone or `gives_up` says so. Never a SIGPIPE.
bool send_frame(int socket, std::string_view bytes, const std::function<bool()>& gives_up = {});

/// Receives one; nothing if the other end is gone, says more than can be meant, or `gives_up`
/// says so.
std::optional<std::string> receive_frame(int socket, const std::function<bool()>& gives_up = {});

}  // namespace nacre
