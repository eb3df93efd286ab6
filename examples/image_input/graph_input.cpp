#include "examples/image_input/graph_input.h"

#include <OpenImageIO/parallel.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>

#include "examples/image_input/image_name.h"
#include "examples/image_input/image_spec.h"
#include "examples/image_input/read_request.h"

namespace graph_image {

namespace {

/// Calls; what it throws is said in `problem`, and gives false: no exception reaches
/// OpenImageIO.
template <class Call>
bool guarded(std::string& problem, Call&& call) {
  try {
    call();
    return true;
  } catch (const std::bad_alloc&) {
    problem = "there is no memory";
  } catch (const std::exception& thrown) {
    problem = thrown.what();
  }
  if (problem.empty()) problem = "unknown error";
  return false;
}

}  // namespace

int GraphInput::supports(OIIO::string_view feature) const {
  return feature == "arbitrary_metadata" ? 1 : 0;
}

bool GraphInput::valid_file(const std::string& name) const {
  const std::string file = name.substr(0, name.find('?'));
  std::error_code ignored;
  return is_graph_image(file) && std::filesystem::is_regular_file(file, ignored);
}

bool GraphInput::open(const std::string& name, OIIO::ImageSpec& spec) {
  return open_with(name, spec, nullptr);
}

bool GraphInput::open(const std::string& name, OIIO::ImageSpec& spec,
                      const OIIO::ImageSpec& config) {
  return open_with(name, spec, &config);
}

bool GraphInput::open_with(const std::string& name, OIIO::ImageSpec& spec,
                           const OIIO::ImageSpec* config) {
  close();
  // OpenImageIO tries all readers on files that it does not know, with a lock held that reading
  // images of a document takes, too: other files are refused before anything is done.
  if (!is_graph_image(name.substr(0, name.find('?')))) {
    errorfmt("\"{}\" is no MaterialX document", name);
    return false;
  }
  std::string problem;
  const bool done = guarded(problem, [&] {
    request_ = read_request(name, config);
    graph_ = open_graph_(request_);
    if (request_.width == 0) {
      request_.width = graph_->info().width;
      request_.height = graph_->info().height;
    }
    levels_ = level_count(request_.width, request_.height);
    level_ = 0;
    m_spec = spec_of(graph_->info(), request_, level_of(request_, 0));
  });
  if (!done) {
    close();
    errorfmt("{}", problem);
    return false;
  }
  spec = m_spec;
  return true;
}

bool GraphInput::close() {
  graph_.reset();
  levels_ = level_ = 0;
  m_spec = OIIO::ImageSpec();
  return true;
}

bool GraphInput::has_level(int subimage, int level) const {
  return subimage == 0 && level >= 0 && level < levels_;
}

bool GraphInput::seek_subimage(int subimage, int level) {
  if (!has_level(subimage, level)) return false;
  if (level == level_) return true;
  m_spec = spec_of(graph_->info(), request_, level_of(request_, level));
  level_ = level;
  return true;
}

OIIO::ImageSpec GraphInput::spec(int subimage, int level) {
  if (!has_level(subimage, level)) return {};
  return spec_of(graph_->info(), request_, level_of(request_, level));
}

OIIO::ImageSpec GraphInput::spec_dimensions(int subimage, int level) {
  if (!has_level(subimage, level)) return {};
  return dimensions_of(graph_->info(), request_, level_of(request_, level));
}

Texels GraphInput::tile_at(int level, int x, int y) const {
  const Level size = level_of(request_, level);
  return {x, y, std::min(tile_side, size.width - x), std::min(tile_side, size.height - y)};
}

bool GraphInput::shade(int level, const Texels& texels, int row_texels, void* data,
                       std::string& problem) {
  return guarded(problem, [&] {
    const std::vector<float> values = graph_->shade(level_of(request_, level), texels);
    const int channels = graph_->info().components;
    const OIIO::TypeDesc format = format_of(request_);
    const auto texel_bytes = static_cast<OIIO::stride_t>(format.size()) * channels;
    OIIO::convert_image(channels, texels.width, texels.height, 1, values.data(),
                        OIIO::TypeDesc::FLOAT, OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride,
                        data, format, texel_bytes, texel_bytes * row_texels, OIIO::AutoStride);
  });
}

bool GraphInput::read_native_scanline(int subimage, int level, int y, int /*z*/, void* data) {
  if (!has_level(subimage, level)) return false;
  const Level size = level_of(request_, level);
  std::string problem = "the image has no such row";
  const bool is_there = y >= 0 && y < size.height;
  if (is_there && shade(level, {0, y, size.width, 1}, size.width, data, problem)) return true;
  errorfmt("{}", problem);
  return false;
}

bool GraphInput::read_native_tile(int subimage, int level, int x, int y, int z, void* data) {
  return read_native_tiles(subimage, level, x, x + tile_side, y, y + tile_side, z, z + 1, data);
}

bool GraphInput::read_native_tiles(int subimage, int level, int left, int right, int top,
                                   int bottom, int front, int back, void* data) {
  if (!has_level(subimage, level)) return false;
  if (!spec_dimensions(subimage, level).valid_tile_range(left, right, top, bottom, front, back)) {
    errorfmt("no tiles have these corners: {}, {} to {}, {}", left, top, right, bottom);
    return false;
  }
  const auto texel_bytes =
      format_of(request_).size() * static_cast<std::size_t>(graph_->info().components);
  const auto row_bytes = static_cast<std::size_t>(right - left) * texel_bytes;
  // What a tile has beyond the image is nobody's, and not computed.
  std::fill_n(static_cast<char*>(data), static_cast<std::size_t>(bottom - top) * row_bytes, '\0');
  const int columns = (right - left + tile_side - 1) / tile_side;
  const int rows = (bottom - top + tile_side - 1) / tile_side;
  std::mutex mutex;
  std::string first_problem;
  const auto read = [&](std::int64_t index) {
    const int x = left + static_cast<int>(index % columns) * tile_side;
    const int y = top + static_cast<int>(index / columns) * tile_side;
    char* const place = static_cast<char*>(data) + static_cast<std::size_t>(y - top) * row_bytes +
                        static_cast<std::size_t>(x - left) * texel_bytes;
    std::string problem;
    if (shade(level, tile_at(level, x, y), right - left, place, problem)) return;
    const std::lock_guard lock(mutex);
    if (first_problem.empty()) first_problem = problem;
  };
  const std::int64_t count = std::int64_t{columns} * rows;
  if (count == 1) {
    read(0);
  } else {
    OIIO::parallel_for(std::int64_t{0}, count, read, OIIO::paropt(threads()));
  }
  if (first_problem.empty()) return true;
  errorfmt("{}", first_problem);
  return false;
}

}  // namespace graph_image
