#include "tests/nodes/independent/scalar_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nacre::reference {

namespace {

double smooth(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

std::int32_t cell(double x) { return static_cast<std::int32_t>(std::floor(x)); }

std::vector<std::int32_t> cells(const std::vector<double>& p) {
  std::vector<std::int32_t> result;
  for (const double x : p) result.push_back(cell(x));
  return result;
}

double unit(std::uint32_t bits) { return bits / 4294967296.0; }

/// Gradients by the low three or four bits.
constexpr double gradients2[8][2] = {{1, 2}, {-1, 2}, {1, -2}, {-1, -2},
                                     {2, 1}, {2, -1}, {-2, 1}, {-2, -1}};
constexpr double gradients3[16][3] = {
    {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
    {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {0, -1, 1}, {-1, 1, 0}, {0, -1, -1}};

/// shift: which byte of the hash chooses.
double perlin2(Vector2 p, int shift) {
  const std::int32_t x = cell(p[0]);
  const std::int32_t y = cell(p[1]);
  double sum = 0.0;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const double dx = p[0] - x - i;
      const double dy = p[1] - y - j;
      const double* g = gradients2[(hash({x + i, y + j}) >> shift) & 7u];
      const double weight = smooth(1.0 - std::fabs(dx)) * smooth(1.0 - std::fabs(dy));
      sum += weight * (g[0] * dx + g[1] * dy);
    }
  }
  return static_cast<double>(0.6616f) * sum;
}

double perlin3(Vector3 p, int shift) {
  const std::array<std::int32_t, 3> base{cell(p[0]), cell(p[1]), cell(p[2])};
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    std::vector<std::int32_t> key;
    double weight = 1.0;
    Vector3 d{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int step = (corner >> axis) & 1;
      key.push_back(base[axis] + step);
      d[axis] = p[axis] - base[axis] - step;
      weight *= smooth(1.0 - std::fabs(d[axis]));
    }
    const double* g = gradients3[(hash(key) >> shift) & 15u];
    sum += weight * (g[0] * d[0] + g[1] * d[1] + g[2] * d[2]);
  }
  return static_cast<double>(0.9820f) * sum;
}

/// All feature points of the cells around p.
std::vector<std::vector<double>> features(const std::vector<double>& p, double jitter) {
  std::vector<std::vector<double>> points;
  const int count = p.size() == 2 ? 9 : 27;
  for (int n = 0; n < count; ++n) {
    std::vector<double> corner;
    int rest = n;
    for (const double x : p) {
      corner.push_back(std::floor(x) + rest % 3 - 1);
      rest /= 3;
    }
    std::vector<double> point;
    for (std::size_t k = 0; k < p.size(); ++k) {
      point.push_back(corner[k] + (cell_noise(corner, static_cast<int>(k)) - 0.5) * jitter + 0.5);
    }
    points.push_back(point);
  }
  return points;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

}  // namespace

std::uint32_t lookup3(const std::vector<std::uint32_t>& words, std::uint32_t bytes,
                      std::uint32_t initial) {
  std::uint32_t a = 0xdeadbeefu + bytes + initial;
  std::uint32_t b = a;
  std::uint32_t c = a;
  const auto rotate = [](std::uint32_t x, int k) { return std::rotl(x, k); };
  std::size_t at = 0;
  for (; words.size() - at > 3; at += 3) {
    a += words[at];
    b += words[at + 1];
    c += words[at + 2];
    const int amounts[] = {4, 6, 8, 16, 19, 4};
    std::uint32_t* order[] = {&a, &b, &c};
    for (int step = 0; step < 6; ++step) {
      std::uint32_t& x = *order[step % 3];
      std::uint32_t& next = *order[(step + 1) % 3];
      std::uint32_t& previous = *order[(step + 2) % 3];
      x -= previous;
      x ^= rotate(previous, amounts[step]);
      previous += next;
    }
  }
  if (words.size() - at > 2) c += words[at + 2];
  if (words.size() - at > 1) b += words[at + 1];
  if (words.size() - at > 0) a += words[at];
  const int amounts[] = {14, 11, 25, 16, 4, 14, 24};
  std::uint32_t* order[] = {&c, &a, &b};
  for (int step = 0; step < 7; ++step) {
    std::uint32_t& x = *order[step % 3];
    const std::uint32_t previous = *order[(step + 2) % 3];
    x ^= previous;
    x -= rotate(previous, amounts[step]);
  }
  return c;
}

std::uint32_t hash(const std::vector<std::int32_t>& key) {
  std::vector<std::uint32_t> words;
  for (const std::int32_t k : key) words.push_back(static_cast<std::uint32_t>(k));
  return lookup3(words, static_cast<std::uint32_t>(4 * words.size()), 13);
}

double cell_noise(const std::vector<double>& p) { return unit(hash(cells(p))); }

double cell_noise(std::vector<double> p, int k) {
  p.push_back(k);
  return cell_noise(p);
}

double perlin(Vector2 p) { return perlin2(p, 0); }
double perlin(Vector3 p) { return perlin3(p, 0); }
double perlin(Vector2 p, int k) { return perlin2(p, 8 * k); }
double perlin(Vector3 p, int k) { return perlin3(p, 8 * k); }

Vector3 worley(const std::vector<double>& p, double jitter) {
  std::vector<double> distances;
  for (const auto& point : features(p, jitter)) distances.push_back(distance(p, point));
  std::sort(distances.begin(), distances.end());
  return {distances[0], distances[1], distances[2]};
}

std::vector<double> nearest_feature(const std::vector<double>& p, double jitter) {
  const auto points = features(p, jitter);
  return *std::min_element(points.begin(), points.end(), [&](const auto& a, const auto& b) {
    return distance(p, a) < distance(p, b);
  });
}

}  // namespace nacre::reference
