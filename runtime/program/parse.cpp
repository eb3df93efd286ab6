#include "runtime/program/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "runtime/float_environment.h"
#include "runtime/program/fold.h"

namespace nacre {

namespace {

/// A fault of the text; never leaves this file.
struct Fault {
  std::string expected;
  std::string found;
};

/// Takes words off the front of a line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) { skip_blanks(); }

  bool empty() const { return rest_.empty(); }
  std::string_view peek() const { return rest_.substr(0, rest_.find(' ')); }
  std::string_view take() {
    const std::string_view word = peek();
    rest_.remove_prefix(word.size());
    skip_blanks();
    return word;
  }
  std::string_view take_rest() { return std::exchange(rest_, {}); }

 private:
  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }

  std::string_view rest_;
};

template <class T>
T number(std::string_view word, std::string_view what, int base = 10) {
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw Fault{std::string(what), std::string(word)};
  }
  return value;
}

std::uint32_t float_bits(std::string_view word) {
  if (word == "nan") return canonical_nan;
  if (word.starts_with("nan:")) return number<std::uint32_t>(word.substr(4), "bits of a NaN", 16);
  float value = 0.0f;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw Fault{"a number", std::string(word)};
  }
  return std::bit_cast<std::uint32_t>(value);
}

std::uint32_t literal_bits(Scalar type, std::string_view word) {
  switch (type) {
    case Scalar::f32: return float_bits(word);
    case Scalar::i32: return static_cast<std::uint32_t>(number<std::int32_t>(word, "an integer"));
    default:
      if (word != "true" && word != "false") throw Fault{"true or false", std::string(word)};
      return word == "true" ? 1u : 0u;
  }
}

std::optional<Scalar> find_scalar(std::string_view word) {
  for (const Scalar scalar : {Scalar::f32, Scalar::i32, Scalar::b1}) {
    if (word == scalar_name(scalar)) return scalar;
  }
  return std::nullopt;
}

Scalar scalar(std::string_view word) {
  if (const auto found = find_scalar(word)) return *found;
  throw Fault{"f32, i32 or b1", std::string(word)};
}

Op operation(std::string_view word) {
  for (int i = 0; i < op_count; ++i) {
    if (info(static_cast<Op>(i)).name == word) return static_cast<Op>(i);
  }
  throw Fault{"an operation", std::string(word)};
}

template <class T>
std::uint32_t find(const std::vector<T>& list, std::string_view name, std::string_view what) {
  const auto found =
      std::ranges::find(list, name, [](const T& row) -> const std::string& { return row.name; });
  if (found == list.end()) throw Fault{std::string(what), std::string(name)};
  return static_cast<std::uint32_t>(found - list.begin());
}

std::uint32_t find_or_add(std::vector<Channel>& list, std::string_view name, Scalar type) {
  const auto index =
      static_cast<std::uint32_t>(std::ranges::find(list, name, &Channel::name) - list.begin());
  if (index == list.size()) list.push_back({std::string(name), type});
  return index;
}

/// One function after another, the entry last.
class Parser {
 public:
  void line(std::string_view text) {
    Words words(text);
    if (words.empty()) return;
    if (!text.starts_with(' ')) {
      header(words);
    } else if (function_ == 0 && !in_entry_) {
      throw Fault{"a function or the entry", std::string(words.peek())};
    } else {
      instruction(words);
    }
  }

  Program finish() {
    if (!in_entry_) throw Fault{"an entry", "the end"};
    mark_varying(program_);
    return std::move(program_);
  }

  Program& program() { return program_; }

 private:
  Function& code() { return program_.functions[function_]; }

  void header(Words& words) {
    const std::string_view kind = words.take();
    if (in_entry_) throw Fault{"an instruction, indented", std::string(kind)};
    if (kind == "program") {
      program_.name = words.take_rest();
    } else if (kind == "texture") {
      texture(words.take_rest());
    } else if (kind == "parameter") {
      const Scalar type = scalar(words.take());
      const std::string name(words.take());
      expect(words, "=");
      program_.parameters.push_back({name, type, literal_bits(type, words.take())});
    } else if (kind == "table") {
      Table& table = program_.tables.emplace_back();
      table.name = words.take();
      expect(words, "=");
      while (!words.empty()) table.values.push_back(std::bit_cast<float>(float_bits(words.take())));
    } else if (kind == "fitted") {
      program_.fitted_rows = number<std::uint32_t>(words.take(), "how many rows there are");
    } else if (kind == "function") {
      function(words.take_rest());
    } else if (kind == "entry") {
      function_ = 0;
      in_entry_ = true;
      code().name = kind;
    } else {
      throw Fault{"program, texture, parameter, fitted, table, function or entry",
                  std::string(kind)};
    }
    if (!words.empty()) throw Fault{"the end of the line", std::string(words.peek())};
  }

  static void expect(Words& words, std::string_view word) {
    if (words.peek() != word) throw Fault{std::string(word), std::string(words.peek())};
    words.take();
  }

  void texture(std::string_view quoted) {
    if (quoted.size() < 2 || !quoted.starts_with('"') || !quoted.ends_with('"')) {
      throw Fault{"a key in quotes", std::string(quoted)};
    }
    program_.textures.push_back({std::string(quoted.substr(1, quoted.size() - 2))});
  }

  /// "@name.index(f32, i32)"
  void function(std::string_view text) {
    const std::size_t open = text.rfind('(');
    const std::size_t dot = open == std::string_view::npos ? open : text.rfind('.', open);
    if (!text.starts_with('@') || dot == std::string_view::npos || !text.ends_with(')')) {
      throw Fault{"@name.index(types)", std::string(text)};
    }
    function_ = static_cast<std::uint32_t>(program_.functions.size());
    if (number<std::uint32_t>(text.substr(dot + 1, open - dot - 1), "an index") != function_) {
      throw Fault{fmt::format("index {}", function_), std::string(text)};
    }
    Function& added = program_.functions.emplace_back();
    added.name = text.substr(1, dot - 1);
    std::string_view types = text.substr(open + 1, text.size() - open - 2);
    while (!types.empty()) {
      const std::size_t comma = std::min(types.find(", "), types.size());
      added.arguments.push_back(scalar(types.substr(0, comma)));
      types.remove_prefix(std::min(comma + 2, types.size()));
    }
  }

  /// "%3 = f32 add %1 %2"
  void instruction(Words& words) {
    Instruction result;
    const std::string value = fmt::format("%{}", code().code.size());
    const bool named = words.peek().starts_with('%');
    if (named) {
      expect(words, value);
      expect(words, "=");
      if (const auto type = find_scalar(words.peek())) {
        result.type = *type;
        words.take();
      }
    }
    result.op = operation(words.take());
    const bool is_call = result.op == Op::call || result.op == Op::texture_call;
    if (named != (result.type != Scalar::none || is_call)) {
      throw Fault{"a typed value, or none", std::string(info(result.op).name)};
    }
    if (result.op != Op::store) immediate(words, result);
    const std::string_view output = result.op == Op::store ? words.take() : std::string_view();
    operands(words, result);
    const auto first_type = [&] {
      return result.count == 0 ? Scalar::none : code().code[result.operands[0]].type;
    };
    if (result.op == Op::store) {
      result.imm = find_or_add(program_.outputs, output, first_type());
    } else if (result.op == Op::give) {
      give(result.imm, first_type());
    }
    code().code.push_back(result);
  }

  void give(std::uint32_t index, Scalar type) {
    std::vector<Scalar>& results = code().results;
    if (index != results.size()) throw Fault{fmt::format("give {}", results.size()), "another"};
    results.push_back(type);
  }

  void immediate(Words& words, Instruction& to) {
    switch (to.op) {
      case Op::constant: to.imm = literal_bits(to.type, words.take()); break;
      case Op::parameter: to.imm = find(program_.parameters, words.take(), "a parameter"); break;
      case Op::input: to.imm = find_or_add(program_.inputs, words.take(), to.type); break;
      case Op::table: to.imm = find(program_.tables, words.take(), "a table"); break;
      case Op::call: {
        const std::string_view name = words.take();
        to.imm = number<std::uint32_t>(name.substr(name.rfind('.') + 1), "@name.index");
        break;
      }
      case Op::loop: {
        std::string_view bound = words.take();
        const bool must_end = bound.ends_with('!');
        if (must_end) bound.remove_suffix(1);
        to.imm = number<std::uint32_t>(bound, "a number") | (must_end ? loop_must_end : 0u);
        break;
      }
      case Op::argument:
      case Op::give:
      case Op::result:
      case Op::keep:
      case Op::ddx:
      case Op::fitted:
      case Op::texture_call: to.imm = number<std::uint32_t>(words.take(), "a number"); break;
      default: break;
    }
  }

  void operands(Words& words, Instruction& to) {
    std::vector<ValueId> ids;
    while (!words.empty()) {
      const std::string_view word = words.take();
      if (!word.starts_with('%')) throw Fault{"an operand", std::string(word)};
      ids.push_back(number<ValueId>(word.substr(1), "the number of a value"));
      if (ids.back() >= code().code.size())
        throw Fault{"a value defined before", std::string(word)};
    }
    if (to.op == Op::call || to.op == Op::texture_call) {
      std::vector<ValueId>& pool = code().pool;
      to.operands = {static_cast<ValueId>(pool.size()), static_cast<ValueId>(ids.size()), no_value};
      pool.insert(pool.end(), ids.begin(), ids.end());
      return;
    }
    if (ids.size() > to.operands.size()) throw Fault{"at most three operands", "more"};
    std::ranges::copy(ids, to.operands.begin());
    to.count = static_cast<std::uint8_t>(ids.size());
  }

  Program program_;
  std::uint32_t function_ = 0;  ///< Being read.
  bool in_entry_ = false;
};

}  // namespace

std::optional<Program> parse_program(std::string_view text, Diagnostics& diagnostics,
                                     std::string_view file) {
  const ScopedDefaultFloatEnvironment environment;
  SourceLocation where{.file = std::string(file), .line = 0, .column = 0, .path = {}};
  try {
    Parser parser;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++where.line;
      parser.line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (const std::string fault = verify(parser.program()); !fault.empty()) {
      where.line = 0;
      diagnostics.error("program-invalid", where, "the program is not valid", "", fault);
      return std::nullopt;
    }
    return parser.finish();
  } catch (const Fault& fault) {
    diagnostics.error("program-syntax", where, "this is not the text of a program", fault.expected,
                      fault.found);
    return std::nullopt;
  }
}

}  // namespace nacre
