#include "tests/conformance/sweep.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "runtime/channel/channel_name.h"
#include "runtime/channel/channel_table.h"
#include "tests/support/random.h"

namespace nacre::testing {

namespace {

bool is_shader(Type type) {
  return type == Type::surfaceshader || type == Type::displacementshader ||
         type == Type::volumeshader || type == Type::lightshader;
}

}  // namespace

namespace {

/// A host can look up what any kernel asks for.
void expect_described(const Channel& channel) {
  const ChannelName name = parse_channel(channel.name);
  const ChannelGroup* group = find_channel_group(name.group);
  ASSERT_NE(group, nullptr) << channel.name;
  EXPECT_NE(group->role, ChannelRole::result) << channel.name;
  if (group->role == ChannelRole::state) return;
  EXPECT_LT(name.component, group->components) << channel.name;
  EXPECT_EQ(name.component < 0, group->components == 1) << channel.name;
  const bool is_property = group->name == "geomprop.*";
  EXPECT_TRUE(is_property || group->type == channel.type) << channel.name;
}

/// Random numbers that the channel's name decides (FNV-1a).
Random numbers_of(const Channel& channel) {
  std::uint64_t seed = 1469598103934665603ull;
  for (const char c : channel.name)
    seed = (seed ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return Random(seed);
}

/// What a channel holds: a frame and two directions for a surface, else numbers
/// between -2 and 2, whole numbers 0 to 3, and truth values.
std::vector<std::uint32_t> fill(const Channel& channel, std::size_t count) {
  static const std::map<std::string, float> fixed{
      {"N.x", 0.0f},  {"N.y", 0.0f},  {"N.z", 1.0f},  {"T.x", 1.0f},  {"T.y", 0.0f},
      {"T.z", 0.0f},  {"B.x", 0.0f},  {"B.y", 1.0f},  {"B.z", 0.0f},  {"Ng.x", 0.0f},
      {"Ng.y", 0.0f}, {"Ng.z", 1.0f}, {"wo.x", 0.6f}, {"wo.y", 0.0f}, {"wo.z", 0.8f},
      {"wi.x", 0.0f}, {"wi.y", 0.6f}, {"wi.z", 0.8f}};
  Random random = numbers_of(channel);
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t number = random.below(4096);
    if (channel.type == Scalar::f32) {
      float value = static_cast<float>(number) / 1024.0f - 2.0f;
      if (channel.name.starts_with("u.")) value = static_cast<float>(number) / 4096.0f;
      if (const auto known = fixed.find(channel.name); known != fixed.end()) value = known->second;
      values.push_back(std::bit_cast<std::uint32_t>(value));
    } else {
      values.push_back(channel.type == Scalar::b1 ? number & 1 : number & 3);
    }
  }
  return values;
}

}  // namespace

Sweep::Sweep(const Library& library, const NodeDef& def) : def_(def), builder_(library) {
  node_ = builder_.add_node(def.name, "n");
  for (const NodeDefInput& input : def.inputs) {
    if (!input.uniform && is_numeric(input.type))
      builder_.connect(node_, input.name, varying(input));
    if (is_closure(input.type) || is_shader(input.type)) {
      builder_.connect(node_, input.name, closure(input.type, std::string(input.name)));
    }
  }
}

std::optional<Graph> Sweep::finish(const GraphOptions& options, Diagnostics& diagnostics) {
  const Type type = def_.outputs.front().type;
  if (type == Type::bsdf || type == Type::edf) {
    const auto surface = builder_.add_node("ND_surface", "surface");
    builder_.connect(surface, type == Type::bsdf ? "bsdf" : "edf", node_);
    builder_.output("surfaceshader", surface);
  } else {
    for (const NodeDefOutput& output : def_.outputs) {
      builder_.output(std::string(output.name), node_, output.name);
    }
  }
  return builder_.finish(options, diagnostics);
}

GraphBuilder::Node Sweep::geomprop(Type type, const std::string& name) {
  const auto node = builder_.add_node("ND_geompropvalue_" + std::string(type_name(type)), name);
  builder_.set(node, "geomprop", {Type::string, {}, {}, {name}});
  return node;
}

GraphBuilder::Node Sweep::varying(const NodeDefInput& input) {
  const std::string name(input.name);
  if (input.type != Type::matrix33 && input.type != Type::matrix44) {
    return geomprop(input.type, name);
  }
  const bool small = input.type == Type::matrix33;
  const auto matrix = builder_.add_node(
      small ? "ND_creatematrix_vector3_matrix33" : "ND_creatematrix_vector4_matrix44", name);
  for (const char* row : {"in1", "in2", "in3", "in4"}) {
    if (small && row == std::string_view("in4")) continue;
    builder_.connect(matrix, row,
                     geomprop(small ? Type::vector3 : Type::vector4, name + '_' + row));
  }
  return matrix;
}

GraphBuilder::Node Sweep::closure(Type type, const std::string& name) {
  const auto varies = [&](GraphBuilder::Node node, const char* input, Type of) {
    builder_.connect(node, input, geomprop(of, name + '_' + input));
    return node;
  };
  switch (type) {
    case Type::bsdf: return builder_.add_node("ND_oren_nayar_diffuse_bsdf", name);
    case Type::edf: return builder_.add_node("ND_uniform_edf", name);
    case Type::vdf: {
      const auto vdf = builder_.add_node("ND_anisotropic_vdf", name);
      varies(vdf, "absorption", Type::vector3);
      varies(vdf, "scattering", Type::vector3);
      return varies(vdf, "anisotropy", Type::float_);
    }
    case Type::surfaceshader: {
      const auto surface = builder_.add_node("ND_surface", name);
      builder_.connect(surface, "bsdf", closure(Type::bsdf, name + "_bsdf"));
      return varies(surface, "opacity", Type::float_);
    }
    case Type::displacementshader:
      return varies(builder_.add_node("ND_displacement_vector3", name), "displacement",
                    Type::vector3);
    case Type::volumeshader: {
      const auto volume = builder_.add_node("ND_volume", name);
      builder_.connect(volume, "vdf", closure(Type::vdf, name + "_vdf"));
      builder_.connect(volume, "edf", closure(Type::edf, name + "_edf"));
      return volume;
    }
    default: return varies(builder_.add_node("ND_point_light", name), "position", Type::vector3);
  }
}

std::vector<std::uint32_t> edge_values(const Channel& channel, bool wild, std::size_t count) {
  using Limits = std::numeric_limits<float>;
  std::vector<float> numbers{0.0f,  -0.0f,  1.0f,    -1.0f, Limits::denorm_min(),
                             0.5f,  -0.5f,  2.0f,    3.0f,  -7.0f,
                             1e-7f, -1e-7f, 100.25f, 1e6f,  -1e8f,
                             1e8f};
  if (wild) {
    for (const float x : {1e30f, -1e30f, Limits::max(), Limits::infinity(), -Limits::infinity(),
                          Limits::quiet_NaN(), Limits::min()}) {
      numbers.push_back(x);
    }
  }
  const std::vector<std::int32_t> integers{0, 1, -1, 2, 7, 1000, INT32_MAX, INT32_MIN};
  Random random = numbers_of(channel);
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < count; ++i) {
    if (channel.type == Scalar::f32) {
      values.push_back(std::bit_cast<std::uint32_t>(random.pick(numbers)));
    } else if (channel.type == Scalar::i32) {
      values.push_back(static_cast<std::uint32_t>(random.pick(integers)));
    } else {
      values.push_back(random.below(2));
    }
  }
  return values;
}

std::vector<std::uint32_t> sweep_parameters(const BoundKernel& kernel) {
  const std::vector<ParameterSlot>& slots = kernel.program().parameters;
  std::vector<std::uint32_t> parameters = kernel.parameters();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].name.starts_with("geomprop.")) parameters[i] = 1;
  }
  return parameters;
}

Arrays run(const BoundKernel& kernel, const Arrays& known, std::size_t count) {
  const Program& program = kernel.program();
  std::vector<std::vector<std::uint32_t>> inputs;
  std::vector<const void*> in;
  for (const Channel& channel : program.inputs) {
    expect_described(channel);
    const auto given = known.find(channel.name);
    inputs.push_back(given == known.end() ? fill(channel, count) : given->second);
  }
  for (const auto& values : inputs) in.push_back(values.data());
  Arrays outputs;
  std::vector<void*> out;
  for (const Channel& channel : program.outputs) {
    outputs[channel.name].resize(count);
    out.push_back(outputs[channel.name].data());
  }
  EXPECT_EQ(kernel.run(in, out, count, sweep_parameters(kernel)), RunStatus::done);
  return outputs;
}

}  // namespace nacre::testing
