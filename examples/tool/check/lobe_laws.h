#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

struct nacre_shader;

namespace nacre::tool {

/// What leaves of the light that arrives where a material is looked at from `degrees` to its
/// normal; see <nacre/lobe_test.hpp>. Red, green and blue.
struct LobeView {
  double degrees = 0;
  std::array<double, 3> light{}, albedo{};
  double valid = 0;
  double chi_square = 1;  ///< Probability of samples at least as far from the density.
  double reciprocity = 1;
  bool is_too_thin = false;  ///< For quadrature to see the density: no laws_of_density then.
};

/// The laws: of single numbers, and of sums of them, which are tried where the former hold.
/// @{
inline constexpr const char* laws_of_numbers[] = {"finite", "lost",    "unit",   "flags",
                                                  "sides",  "density", "weight", "support"};
inline constexpr const char* laws_of_sums[] = {"normalised", "samples", "light", "energy",
                                               "albedo"};
inline constexpr const char* laws_of_density[] = {"normalised", "samples", "light"};
/// @}

/// A law that does not hold.
struct LobeFault {
  std::string law, text;
  double found = 0, expected = 0;
};

struct LobeFindings {
  std::vector<LobeView> views;
  std::vector<LobeFault> faults;
};

/// How hard a material is looked at.
struct LobeEffort {
  std::size_t samples = 100'000;  ///< Of each view.
  double most_energy = 1.01;      ///< More light than that is a fault.
};

/// Tries the laws, by the public interface alone; destroys the shader. It has a closure.
LobeFindings try_lobes(nacre_shader* shader, const LobeEffort& effort);

}  // namespace nacre::tool
