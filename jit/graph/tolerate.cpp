// GraphOptions::lenient: what the resolver goes on with, and how.
#include <fmt/format.h>

#include "jit/document/value_text.h"
#include "jit/graph/lenient.h"
#include "jit/graph/resolver.h"

namespace nacre {

bool Resolver::tolerates(std::string code, const Element& element, const std::string& message,
                         std::string_view so, std::string expected, std::string found) {
  if (!options_.lenient) {
    error(std::move(code), element, message, std::move(expected), std::move(found));
    return false;
  }
  warning(std::move(code), element, fmt::format("{}, so {}", message, so), std::move(expected),
          std::move(found));
  return true;
}

// Inlined graphs meet the same port in many contexts: warnings are given once.
Connection Resolver::connection_of(const Element& port) {
  Diagnostics said;
  const Connection connection = find_connection(port, said, options_.lenient);
  for (const Diagnostic& one : said.all()) {
    const bool is_new = one.severity == Severity::error ||
                        reported_.emplace(one.code + element_path(port), true).second;
    if (is_new) diagnostics_.add(one);
  }
  return connection;
}

std::optional<Resolver::Key> Resolver::retype(Result& result, Type type, const std::string& path,
                                              const Element& user) {
  const Type from = result.type;
  result.type = type;
  if (result.source.kind == Source::Kind::literal) {
    result.source.value = as_type(result.source.value, type);
    return std::nullopt;
  }
  if (result.source.kind == Source::Kind::unconnected) {
    result.source.kind = Source::Kind::literal;
    result.source.value = as_type(zero_value(from), type);
    return std::nullopt;
  }
  const auto find = [&](const std::string& name) {
    const NodeDef* def = definitions_.nodedef(name);
    if (def == nullptr) {
      error("unknown-nodedef", user, "types cannot be converted without the standard library",
            name);
      result.failed = true;
    }
    return def;
  };
  Source source = result.source;
  const bool is_number = from == Type::float_ || from == Type::integer;
  if (!is_number || type == Type::float_) {
    const NodeDef* def = find(fmt::format("ND_convert_{}_{}", type_name(from), type_name(type)));
    if (def == nullptr) return std::nullopt;
    Instance& instance = add_instance(*def, path + ":type", &user);
    instance.inputs.emplace_back("in", source);
    return Key{Kind::output, 0, &instance, nullptr};
  }
  const int count = component_count(type);
  const NodeDef* def = find(fmt::format("ND_combine{}_{}", count, type_name(type)));
  if (def == nullptr) return std::nullopt;
  if (from == Type::integer) {
    const NodeDef* convert = find("ND_convert_integer_float");
    if (convert == nullptr) return std::nullopt;
    Instance& instance = add_instance(*convert, path + ":number", &user);
    instance.inputs.emplace_back("in", source);
    const Result number = run({Kind::output, 0, &instance, nullptr});
    result.failed = number.failed;
    if (number.failed) return std::nullopt;
    source = number.source;
  }
  Instance& instance = add_instance(*def, path + ":type", &user);
  for (int i = 0; i < count; ++i)
    instance.inputs.emplace_back(def->inputs[std::size_t(i)].name, source);
  return Key{Kind::output, 0, &instance, nullptr};
}

}  // namespace nacre
