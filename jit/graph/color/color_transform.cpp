// Colour spaces by their primaries and transfer curves, and transforms between
// them as graphs of standard nodes.
#include <fmt/format.h>

#include <array>

#include "jit/graph/color/colorspace.h"

namespace nacre {

namespace {

struct Chromaticity {
  double x, y;
};

struct Gamut {
  std::string_view name;
  Chromaticity red, green, blue, white;
};

constexpr Chromaticity d65{0.3127, 0.3290};
constexpr Chromaticity aces_white{0.32168, 0.33767};

// Primaries and white points: ITU-R BT.709-6 and BT.2020-2, item 1; SMPTE ST 2065-1
// (AP0); Academy S-2014-004 (AP1); SMPTE EG 432-1 with D65 (P3-D65); Adobe RGB (1998)
// Color Image Encoding, 4.3.1. "xyz": the tristimulus values themselves.
constexpr std::array<Gamut, 7> gamuts{{
    {"rec709", {0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, d65},
    {"rec2020", {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65},
    {"ap0", {0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}, aces_white},
    {"ap1", {0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, aces_white},
    {"p3d65", {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65},
    {"adobergb", {0.640, 0.330}, {0.210, 0.710}, {0.150, 0.060}, d65},
    {"xyz", {1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, d65},
}};

struct Space {
  std::string_view name;
  std::string_view gamut;
  double gamma = 1.0;  ///< Linear light is code to this power; 0: the curve of sRGB.
};

constexpr double srgb_curve = 0.0;  // IEC 61966-2-1, 5.2

constexpr std::array spaces = std::to_array<Space>({
    {"lin_rec709", "rec709"},
    {"lin_rec2020", "rec2020"},
    {"lin_ap0", "ap0"},
    {"acescg", "ap1"},
    {"lin_displayp3", "p3d65"},
    {"lin_adobergb", "adobergb"},
    {"lin_ciexyzd65", "xyz"},
    {"srgb_texture", "rec709", srgb_curve},
    {"srgb_displayp3", "p3d65", srgb_curve},
    {"srgb_ap1", "ap1", srgb_curve},
    {"g18_rec709", "rec709", 1.8},
    {"g22_rec709", "rec709", 2.2},
    {"rec709_display", "rec709", 2.4},
    {"g22_ap1", "ap1", 2.2},
    {"adobergb", "adobergb", 563.0 / 256.0},
});

const Space* find_space(std::string_view name) {
  for (const Space& space : spaces) {
    if (space.name == name) return &space;
  }
  return nullptr;
}

using Vector = std::array<double, 3>;

Vector multiply(const Vector& v, const ColorMatrix& m) {
  Vector result{};
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t k = 0; k < 3; ++k) result[column] += v[k] * m[k][column];
  }
  return result;
}

ColorMatrix multiply(const ColorMatrix& a, const ColorMatrix& b) {
  return {multiply(a[0], b), multiply(a[1], b), multiply(a[2], b)};
}

ColorMatrix inverse(const ColorMatrix& m) {
  ColorMatrix adjugate{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      adjugate[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
    }
  }
  const double determinant =
      m[0][0] * adjugate[0][0] + m[0][1] * adjugate[1][0] + m[0][2] * adjugate[2][0];
  for (Vector& row : adjugate) {
    for (double& number : row) number /= determinant;
  }
  return adjugate;
}

// Tristimulus values at luminance 1.
Vector to_xyz(Chromaticity c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

// Lam's cone responses, as the Bradford adaptation uses them (CIECAM97s), for rows.
constexpr ColorMatrix bradford{
    {{0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685}, {-0.1614, 0.0367, 1.0296}}};

ColorMatrix adaptation(Chromaticity from, Chromaticity to) {
  const Vector source = multiply(to_xyz(from), bradford);
  const Vector target = multiply(to_xyz(to), bradford);
  ColorMatrix scale{};
  for (std::size_t i = 0; i < 3; ++i) scale[i][i] = target[i] / source[i];
  return multiply(multiply(bradford, scale), inverse(bradford));
}

// Linear light to tristimulus values relative to D65; SMPTE RP 177, 3.3.
ColorMatrix to_xyz_d65(const Gamut& gamut) {
  ColorMatrix primaries{};
  const std::array<Chromaticity, 3> corners{gamut.red, gamut.green, gamut.blue};
  for (std::size_t i = 0; i < 3; ++i) {
    primaries[i] = {corners[i].x, corners[i].y, 1.0 - corners[i].x - corners[i].y};
  }
  if (gamut.name == "xyz") return primaries;
  const Vector scale = multiply(to_xyz(gamut.white), inverse(primaries));
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& number : primaries[i]) number *= scale[i];
  }
  return multiply(primaries, adaptation(gamut.white, d65));
}

const Gamut& gamut_of(const Space& space) {
  for (const Gamut& gamut : gamuts) {
    if (gamut.name == space.gamut) return gamut;
  }
  return gamuts[0];
}

// A chain of color3 nodes; each step reads what the last one made.
class Chain {
 public:
  // `inputs`: of the node beside the one that the chain goes through.
  void node(std::string_view category, std::string_view through, std::string_view inputs) {
    const std::string name = fmt::format("n{}", ++count_);
    text_ += fmt::format("<{} name=\"{}\" type=\"color3\">{}{}</{}>\n", category, name,
                         last(through), inputs, category);
    last_ = name;
  }

  void decode(double gamma) {
    if (gamma == 1.0) return;
    if (gamma == srgb_curve) return node("srgb_texture_to_lin_rec709", "in", "");
    power(gamma);
  }

  void matrix(const ColorMatrix& m) {
    std::string numbers;
    for (const Vector& row : m) {
      for (const double number : row) {
        numbers += fmt::format("{}{:.9g}", numbers.empty() ? "" : ", ", number);
      }
    }
    text_ += fmt::format("<convert name=\"vector\" type=\"vector3\">{}</convert>\n", last("in"));
    text_ += fmt::format(
        "<transformmatrix name=\"matrix\" type=\"vector3\">"
        "<input name=\"in\" type=\"vector3\" nodename=\"vector\"/>"
        "<input name=\"mat\" type=\"matrix33\" value=\"{}\"/></transformmatrix>\n"
        "<convert name=\"color\" type=\"color3\">"
        "<input name=\"in\" type=\"vector3\" nodename=\"matrix\"/></convert>\n",
        numbers);
    last_ = "color";
  }

  void encode(double gamma) {
    if (gamma == 1.0) return;
    if (gamma != srgb_curve) return power(1.0 / gamma);
    // 12.92 c up to 0.0031308, 1.055 c^(1/2.4) - 0.055 above.
    const std::string light = last("in");
    text_ += fmt::format("<separate3 name=\"parts\" type=\"multioutput\">{}</separate3>\n", light);
    std::string parts;
    int number = 0;
    for (const std::string_view channel : {"outr", "outg", "outb"}) {
      ++number;
      text_ += fmt::format(
          "<ifgreater name=\"above{0}\" type=\"float\">"
          "<input name=\"value1\" type=\"float\" nodename=\"parts\" output=\"{1}\"/>"
          "<input name=\"value2\" type=\"float\" value=\"0.0031308\"/>"
          "<input name=\"in1\" type=\"float\" value=\"1\"/>"
          "<input name=\"in2\" type=\"float\" value=\"0\"/></ifgreater>\n",
          number, channel);
      parts += fmt::format("<input name=\"in{0}\" type=\"float\" nodename=\"above{0}\"/>", number);
    }
    text_ += fmt::format("<combine3 name=\"above\" type=\"color3\">{}</combine3>\n", parts);
    text_ += fmt::format("<multiply name=\"low\" type=\"color3\">{}{}</multiply>\n",
                         renamed(light, "in1"), number_input("in2", 12.92));
    power(1.0 / 2.4);
    node("multiply", "in1", number_input("in2", 1.055));
    node("subtract", "in1", number_input("in2", 0.055));
    node("mix", "fg",
         "<input name=\"bg\" type=\"color3\" nodename=\"low\"/>"
         "<input name=\"mix\" type=\"color3\" nodename=\"above\"/>");
  }

  std::string finish() {
    return text_ + fmt::format("<output name=\"out\" type=\"color3\" nodename=\"{}\"/>\n", last_);
  }

 private:
  void power(double exponent) {
    node("max", "in1", number_input("in2", 0.0));
    node("power", "in1", number_input("in2", exponent));
  }

  static std::string number_input(std::string_view name, double value) {
    return fmt::format("<input name=\"{}\" type=\"float\" value=\"{:.9g}\"/>", name, value);
  }

  static std::string renamed(std::string input, std::string_view name) {
    return input.replace(input.find("\"in\""), 4, fmt::format("\"{}\"", name));
  }

  std::string last(std::string_view input) const {
    if (last_.empty()) {
      return fmt::format("<input name=\"{}\" type=\"color3\" interfacename=\"in\"/>", input);
    }
    return fmt::format("<input name=\"{}\" type=\"color3\" nodename=\"{}\"/>", input, last_);
  }

  std::string text_;
  std::string last_;
  int count_ = 0;
};

// As Chain does it.
std::string decode_glsl(double gamma) {
  if (gamma == 1.0) return "";
  if (gamma != srgb_curve) return fmt::format("  c = pow(max(c, 0.0), vec3({:#.9g}));\n", gamma);
  return "  c = mix(c / 12.92, pow(max(c + 0.055, 0.0) / 1.055, vec3(2.4)), "
         "greaterThan(c, vec3(0.04045)));\n";
}

std::string encode_glsl(double gamma) {
  if (gamma == 1.0) return "";
  if (gamma != srgb_curve) return decode_glsl(1.0 / gamma);
  return "  c = mix(12.92 * c, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, "
         "greaterThan(c, vec3(0.0031308)));\n";
}

// Columns of GLSL's matrix are columns here, so that it stands behind a row too.
std::string matrix_glsl(const ColorMatrix& m) {
  std::string numbers;
  for (std::size_t column = 0; column < 3; ++column) {
    for (const Vector& row : m) {
      numbers += fmt::format("{}{:#.9g}", numbers.empty() ? "" : ", ", row[column]);
    }
  }
  return fmt::format("  c = c * mat3({});\n", numbers);
}

}  // namespace

std::optional<ColorMatrix> color_matrix(std::string_view from, std::string_view to) {
  const Space* source = find_space(from);
  const Space* target = find_space(to);
  if (source == nullptr || target == nullptr) return std::nullopt;
  return multiply(to_xyz_d65(gamut_of(*source)), inverse(to_xyz_d65(gamut_of(*target))));
}

std::string color_transform_glsl(std::string_view from, std::string_view to,
                                 std::string_view function) {
  const Space* source = find_space(from);
  const Space* target = find_space(to);
  if (source == nullptr || target == nullptr) return {};
  return fmt::format("vec3 {}(vec3 c) {{\n{}{}{}  return c;\n}}\n", function,
                     decode_glsl(source->gamma),
                     source->gamut == target->gamut ? "" : matrix_glsl(*color_matrix(from, to)),
                     encode_glsl(target->gamma));
}

std::string color_transform_nodedefs(std::string_view name) {
  std::string text;
  for (const int channels : {3, 4}) {
    text += fmt::format(
        "<nodedef name=\"ND_{0}_color{1}\" node=\"{0}\" nodegroup=\"colortransform\">"
        "<input name=\"in\" type=\"color{1}\" value=\"{2}\"/>"
        "<output name=\"out\" type=\"color{1}\" defaultinput=\"in\"/></nodedef>\n",
        name, channels, channels == 3 ? "0, 0, 0" : "0, 0, 0, 1");
  }
  return text;
}

std::string color_transform_text(std::string_view from, std::string_view to) {
  const Space* source = find_space(from);
  const Space* target = find_space(to);
  if (source == nullptr || target == nullptr) return {};
  Chain chain;
  chain.decode(source->gamma);
  if (source->gamut != target->gamut) chain.matrix(*color_matrix(from, to));
  chain.encode(target->gamma);
  const std::string name = fmt::format("{}_to_{}", from, to);
  std::string text = "<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">\n";
  text += color_transform_nodedefs(name);
  text +=
      fmt::format("<nodegraph name=\"NG_{0}_color3\" nodedef=\"ND_{0}_color3\">\n{1}</nodegraph>\n",
                  name, chain.finish());
  text += fmt::format(
      "<nodegraph name=\"NG_{0}_color4\" nodedef=\"ND_{0}_color4\">\n"
      "<convert name=\"rgb\" type=\"color3\">"
      "<input name=\"in\" type=\"color4\" interfacename=\"in\"/></convert>\n"
      "<{0} name=\"transform\" type=\"color3\" nodedef=\"ND_{0}_color3\">"
      "<input name=\"in\" type=\"color3\" nodename=\"rgb\"/></{0}>\n"
      "<extract name=\"alpha\" type=\"float\">"
      "<input name=\"in\" type=\"color4\" interfacename=\"in\"/>"
      "<input name=\"index\" type=\"integer\" value=\"3\"/></extract>\n"
      "<combine2 name=\"rgba\" type=\"color4\">"
      "<input name=\"in1\" type=\"color3\" nodename=\"transform\"/>"
      "<input name=\"in2\" type=\"float\" nodename=\"alpha\"/></combine2>\n"
      "<output name=\"out\" type=\"color4\" nodename=\"rgba\"/></nodegraph>\n</materialx>\n",
      name);
  return text;
}

}  // namespace nacre
