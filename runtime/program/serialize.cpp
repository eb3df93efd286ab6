#include "runtime/program/serialize.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "runtime/bytes.h"

namespace nacre {

namespace {

template <class T>
void add_named(BytesOut& out, const std::vector<T>& list) {
  out.add(static_cast<std::uint64_t>(list.size()));
  for (const T& one : list) {
    out.add_text(one.name);
    out.add(one.type);
  }
}

void add(BytesOut& out, const Function& function) {
  out.add_text(function.name);
  out.add_list(function.arguments);
  out.add_list(function.results);
  out.add_list(function.code);
  out.add_list(function.pool);
}

bool is_scalar(Scalar scalar) { return scalar <= Scalar::b1; }

bool are_scalars(const std::vector<Scalar>& list) {
  for (const Scalar scalar : list) {
    if (!is_scalar(scalar)) return false;
  }
  return true;
}

bool take(BytesIn& in, Function& function) {
  function.name = in.take_text();
  function.arguments = in.take_list<Scalar>();
  function.results = in.take_list<Scalar>();
  function.code = in.take_list<Instruction>();
  function.pool = in.take_list<ValueId>();
  for (const Instruction& instruction : function.code) {
    if (instruction.op > Op::store || !is_scalar(instruction.type)) return false;
  }
  return are_scalars(function.arguments) && are_scalars(function.results);
}

template <class T>
bool take_named(BytesIn& in, std::vector<T>& list) {
  list.resize(in.take_count(sizeof(std::uint64_t) + sizeof(Scalar)));
  for (T& one : list) {
    one.name = in.take_text();
    one.type = in.take<Scalar>();
    if (!is_scalar(one.type)) return false;
  }
  return true;
}

}  // namespace

std::string fits_to_bytes(const Program& program) {
  if (program.fitted_rows == 0) return {};
  BytesOut out;
  out.add(program.fitted_rows);
  out.add(static_cast<std::uint64_t>(program.fits.size()));
  for (const Fit& fit : program.fits) {
    out.add_text(to_bytes(*fit.maker));
    out.add_list(fit.slots);
    out.add(fit.row);
    out.add(fit.low);
    out.add(fit.high);
    out.add(fit.error);
  }
  return out.take();
}

bool take_fits(std::string_view bytes, Program& program) {
  if (bytes.empty()) return true;
  BytesIn in(bytes);
  program.fitted_rows = in.take<std::uint32_t>();
  program.fits.resize(in.take_count(2 * sizeof(std::uint64_t) + 4 * sizeof(std::uint32_t)));
  if (program.fits.size() > Fit::most || program.fitted_rows < Fit::first_rows) return false;
  for (Fit& fit : program.fits) {
    auto maker = program_from_bytes(in.take_text());
    if (!maker) return false;
    fit.slots = in.take_list<std::uint32_t>();
    fit.row = in.take<std::uint32_t>();
    fit.low = in.take<float>();
    fit.high = in.take<float>();
    fit.error = in.take<float>();
    const std::uint64_t rows = Fit::coefficients * std::uint64_t{maker->outputs.size()};
    const auto is_number = [](const Channel& channel) { return channel.type == Scalar::f32; };
    const bool fits = fit.row >= Fit::first_rows && fit.row + rows <= program.fitted_rows &&
                      maker->inputs.size() == 1 && is_number(maker->inputs.front()) &&
                      std::ranges::all_of(maker->outputs, is_number) &&
                      fit.slots.size() == maker->parameters.size();
    if (!fits) return false;
    fit.maker = std::make_shared<const Program>(std::move(*maker));
  }
  return in.is_whole();
}

std::string to_bytes(const Program& program) {
  BytesOut out;
  out.add_text(program.name);
  out.add(static_cast<std::uint64_t>(program.functions.size()));
  for (const Function& function : program.functions) add(out, function);
  add_named(out, program.inputs);
  add_named(out, program.outputs);
  add_named(out, program.parameters);
  for (const ParameterSlot& slot : program.parameters) out.add(slot.value);
  out.add(static_cast<std::uint64_t>(program.tables.size()));
  for (const Table& table : program.tables) {
    out.add_text(table.name);
    out.add_list(table.values);
  }
  out.add(static_cast<std::uint64_t>(program.textures.size()));
  for (const TextureSlot& slot : program.textures) out.add_text(slot.key);
  out.add_text(fits_to_bytes(program));
  out.add(static_cast<std::uint64_t>(program.origins.size()));
  for (const std::string& origin : program.origins) out.add_text(origin);
  return out.take();
}

std::optional<Program> program_from_bytes(std::string_view bytes) {
  BytesIn in(bytes);
  Program program;
  program.name = in.take_text();
  program.functions.resize(in.take_count(5 * sizeof(std::uint64_t)));
  bool fits = !program.functions.empty();
  for (Function& function : program.functions) fits = fits && take(in, function);
  fits = fits && take_named(in, program.inputs) && take_named(in, program.outputs) &&
         take_named(in, program.parameters);
  if (!fits) return std::nullopt;
  for (ParameterSlot& slot : program.parameters) slot.value = in.take<std::uint32_t>();
  program.tables.resize(in.take_count(2 * sizeof(std::uint64_t)));
  for (Table& table : program.tables) {
    table.name = in.take_text();
    table.values = in.take_list<float>();
  }
  program.textures.resize(in.take_count(sizeof(std::uint64_t)));
  for (TextureSlot& slot : program.textures) slot.key = in.take_text();
  if (!take_fits(in.take_text(), program)) return std::nullopt;
  program.origins.resize(in.take_count(sizeof(std::uint64_t)));
  for (std::string& origin : program.origins) origin = in.take_text();
  if (!in.is_whole()) return std::nullopt;
  return program;
}

}  // namespace nacre
