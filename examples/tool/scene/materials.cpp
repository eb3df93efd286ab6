#include "examples/tool/scene/materials.h"

#include <algorithm>
#include <filesystem>

#include "examples/common/atomic_file.h"
#include "examples/render/load_scene.h"
#include "examples/tool/process.h"
#include "examples/tool/scene/document.h"
#include "examples/tool/scene/images.h"

namespace nacre::tool {

namespace {

namespace fs = std::filesystem;

std::string folder_of(const std::string& file) {
  const std::string folder = fs::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool write(const RenderOptions& options, const host::Scene& scene,
           const std::vector<std::string>& files, const std::string& text,
           Diagnostics& diagnostics) {
  const std::string& out = options.document;
  if (!host::prepare_output(out, diagnostics) ||
      !write_scene_images(scene.materials.images, files, folder_of(out), diagnostics) ||
      !host::write_text_atomically(out, text, diagnostics)) {
    return false;
  }
  const bool is_outside =
      std::ranges::any_of(files, [](const std::string& file) { return file.starts_with(".."); });
  if (is_outside) {
    diagnostics.warning("other-folder", {out, 0, 0, {}},
                        "images of the scene are outside the folder of the document",
                        "--allow-outside or a --search-path where the document is read");
  }
  file_is_written(out, options.common.quiet);
  return true;
}

}  // namespace

bool has_own_materials(const RenderOptions& options) { return options.common.file.empty(); }

bool check_request(const RenderOptions& options, Diagnostics& diagnostics) {
  const bool has_own = has_own_materials(options);
  const auto fail = [&](const char* message, const char* expected) {
    diagnostics.error("bad-request", {}, message, expected);
    return false;
  };
  if (has_own && options.scene.empty()) {
    return fail("there is nothing to render", "FILE.mtlx, or --scene FILE.glb with materials");
  }
  if (has_own && !host::has_materials(options.scene)) {
    return fail("the materials of this scene are not read", "FILE.mtlx, or a .glb or .gltf");
  }
  if (!has_own && !options.document.empty()) {
    return fail("--write-document writes the scene's own materials", "no FILE.mtlx beside it");
  }
  if (options.out.empty() && options.document.empty()) {
    return fail("no image is asked for", "--out FILE, an .exr or .png");
  }
  return true;
}

Opened open_scene_materials(const RenderOptions& options, host::Scene& scene,
                            Diagnostics& diagnostics) {
  const bool is_written = !options.document.empty();
  const fs::path named = is_written ? options.document : options.scene;
  const std::vector<std::string> files =
      scene_image_files(scene.materials.images, options.scene, named.stem().string(),
                        is_written ? folder_of(options.document) : "");
  CommonOptions common = options.common;
  common.search_paths.push_back(folder_of(options.scene));
  Opened opened =
      open_system(common, scene_image_resolver(scene.materials.images, files), diagnostics);
  if (opened.system == nullptr) return {};
  const SceneDocument made = make_scene_document(scene, options.scene, files,
                                                 opened.system->library().document(), diagnostics);
  if (is_written && !write(options, scene, files, made.text_with_look, diagnostics)) return {};
  const std::string& name = is_written ? options.document : options.scene;
  opened.document = read_document_text(made.text, name, common.read_options(), diagnostics);
  return opened;
}

void take_sides(const host::Scene& scene, std::vector<MeshAssignment>& assignments) {
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    const host::Mesh& mesh = scene.meshes[i];
    if (mesh.is_stage) continue;
    assignments[i].two_sided = mesh.material && scene.materials.all[*mesh.material].two_sided;
  }
}

}  // namespace nacre::tool
