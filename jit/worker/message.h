#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "jit/llvm/codegen.h"
#include "runtime/diagnostic.h"
#include "runtime/program/program.h"

namespace nacre {

/// What goes over the socket between a host and nacre-compile-worker: a request, then its
/// answer, each as a frame of 8 bytes that say how long it is and so many bytes.

/// The descriptor that a worker finds its end of the socket at.
inline constexpr int worker_socket = 3;

/// The status of a worker that ran out of memory.
inline constexpr int worker_out_of_memory = 3;

/// What a library and a worker have to agree in: else they are of different versions.
std::string worker_version();

struct CompileRequest {
  CodegenOptions options;
  Program program;
  double seconds = 0;  ///< After which the worker ends itself, if nobody else has.
};
std::string to_bytes(const CompileRequest& request);
/// Nothing for a frame of another version.
std::optional<CompileRequest> request_from_bytes(std::string_view bytes);

struct CompileAnswer {
  std::optional<ObjectCode> object;
  std::string fault;   ///< Where LLVM gave up; then the worker has ended.
  std::string digest;  ///< to_hex(code_digest()) of the Program that it has got.
  CompileStats stats;
  Diagnostics diagnostics;
};
std::string to_bytes(const CompileAnswer& answer);
std::optional<CompileAnswer> answer_from_bytes(std::string_view bytes);

}  // namespace nacre
