#include "jit/worker/socket.h"

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace nacre {

namespace {

constexpr std::uint64_t largest_frame = std::uint64_t{1} << 32;
constexpr int milliseconds_between_questions = 50;

/// Waits until the socket can do what `events` say; false where it never will.
bool wait_for(int socket, short events, const std::function<bool()>& gives_up) {
  while (true) {
    pollfd waiting{.fd = socket, .events = events, .revents = 0};
    const int ready = ::poll(&waiting, 1, gives_up ? milliseconds_between_questions : -1);
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
    if (gives_up && gives_up()) return false;
  }
}

bool send_all(int socket, const char* bytes, std::size_t size,
              const std::function<bool()>& gives_up) {
  while (size > 0) {
    if (!wait_for(socket, POLLOUT, gives_up)) return false;
    const ssize_t sent = ::send(socket, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (sent <= 0) return false;
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, char* bytes, std::size_t size, const std::function<bool()>& gives_up) {
  while (size > 0) {
    if (!wait_for(socket, POLLIN, gives_up)) return false;
    const ssize_t got = ::recv(socket, bytes, size, MSG_DONTWAIT);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got <= 0) return false;
    bytes += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

bool send_frame(int socket, std::string_view bytes, const std::function<bool()>& gives_up) {
  const std::uint64_t size = bytes.size();
  char head[sizeof size];
  std::memcpy(head, &size, sizeof size);
  return send_all(socket, head, sizeof head, gives_up) &&
         send_all(socket, bytes.data(), bytes.size(), gives_up);
}

std::optional<std::string> receive_frame(int socket, const std::function<bool()>& gives_up) {
  std::uint64_t size = 0;
  char head[sizeof size];
  if (!receive_all(socket, head, sizeof head, gives_up)) return std::nullopt;
  std::memcpy(&size, head, sizeof size);
  if (size > largest_frame) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (!receive_all(socket, bytes.data(), bytes.size(), gives_up)) return std::nullopt;
  return bytes;
}

}  // namespace nacre
