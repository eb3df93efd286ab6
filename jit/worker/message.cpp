#include "jit/worker/message.h"

#include <fmt/format.h>

#include <utility>

#include "runtime/bytes.h"
#include "runtime/program/serialize.h"

namespace nacre {

namespace {

/// To be raised when frames change, or what is in them.
constexpr int protocol_version = 2;

}  // namespace

std::string worker_version() {
  return fmt::format("{} protocol {}", code_version(), protocol_version);
}

std::string to_bytes(const CompileRequest& request) {
  BytesOut out;
  out.add_text(worker_version());
  out.add(request.options.lanes);
  out.add_text(request.options.target.cpu);
  out.add_text(request.options.target.features);
  out.add(request.options.accuracy);
  out.add(request.options.tier);
  out.add(request.options.max_steps);
  out.add(request.options.uncut);
  out.add(request.options.part);
  out.add(request.options.line_tables);
  out.add(request.seconds);
  out.add_text(to_bytes(request.program));
  return out.take();
}

std::optional<CompileRequest> request_from_bytes(std::string_view bytes) {
  BytesIn in(bytes);
  if (in.take_text() != worker_version()) return std::nullopt;
  CompileRequest request;
  request.options.lanes = in.take<int>();
  request.options.target.cpu = in.take_text();
  request.options.target.features = in.take_text();
  request.options.accuracy = in.take<Accuracy>();
  request.options.tier = in.take<Tier>();
  request.options.max_steps = in.take<std::uint64_t>();
  request.options.uncut = in.take<std::uint32_t>();
  request.options.part = in.take<std::uint32_t>();
  request.options.line_tables = in.take<bool>();
  request.seconds = in.take<double>();
  auto program = program_from_bytes(in.take_text());
  if (!program || !in.is_whole()) return std::nullopt;
  request.program = std::move(*program);
  return request;
}

std::string to_bytes(const CompileAnswer& answer) {
  BytesOut out;
  out.add(static_cast<std::uint8_t>(answer.object.has_value() ? 1 : 0));
  if (answer.object) {
    out.add_text(answer.object->symbol);
    out.add_text(answer.object->interface);
    out.add_list(answer.object->bytes);
  }
  out.add_text(answer.fault);
  out.add_text(answer.digest);
  for (const double seconds : {answer.stats.emit, answer.stats.optimize, answer.stats.codegen}) {
    out.add(seconds);
  }
  out.add(static_cast<std::uint64_t>(answer.diagnostics.all().size()));
  for (const Diagnostic& one : answer.diagnostics.all()) {
    out.add(static_cast<std::uint8_t>(one.severity));
    for (const std::string* text : {&one.code, &one.message, &one.expected, &one.found}) {
      out.add_text(*text);
    }
  }
  return out.take();
}

std::optional<CompileAnswer> answer_from_bytes(std::string_view bytes) {
  BytesIn in(bytes);
  CompileAnswer answer;
  // As numbers: a process that went wrong may say anything.
  if (in.take<std::uint8_t>() != 0) {
    answer.object.emplace();
    answer.object->symbol = in.take_text();
    answer.object->interface = in.take_text();
    answer.object->bytes = in.take_list<char>();
    answer.stats.object_bytes = answer.object->bytes.size();
  }
  answer.fault = in.take_text();
  answer.digest = in.take_text();
  for (double* seconds : {&answer.stats.emit, &answer.stats.optimize, &answer.stats.codegen}) {
    *seconds = in.take<double>();
  }
  const std::size_t count = in.take_count(sizeof(std::uint8_t) + 4 * sizeof(std::uint64_t));
  for (std::size_t i = 0; i < count; ++i) {
    Diagnostic one;
    const auto severity = in.take<std::uint8_t>();
    if (severity > static_cast<std::uint8_t>(Severity::error)) return std::nullopt;
    one.severity = static_cast<Severity>(severity);
    for (std::string* text : {&one.code, &one.message, &one.expected, &one.found}) {
      *text = in.take_text();
    }
    answer.diagnostics.add(std::move(one));
  }
  if (!in.is_whole()) return std::nullopt;
  return answer;
}

}  // namespace nacre
