#pragma once

#include <string>
#include <vector>

#include "examples/render/scene_material.h"
#include "jit/document/file_resolver.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// What the images of a scene are called in a document of their materials, which stands in
/// `folder` ("": where the scene does): those within the scene file STEM_imageN with their
/// extension, the others as they are called from there.
std::vector<std::string> scene_image_files(const std::vector<host::SceneImage>& images,
                                           const std::string& scene_file, const std::string& stem,
                                           const std::string& folder);

/// Finds those that are within the scene file.
FileResolver scene_image_resolver(const std::vector<host::SceneImage>& images,
                                  const std::vector<std::string>& files);

/// Writes those into the folder. False after an error.
bool write_scene_images(const std::vector<host::SceneImage>& images,
                        const std::vector<std::string>& files, const std::string& folder,
                        Diagnostics& diagnostics);

}  // namespace nacre::tool
