#pragma once

#include <memory>
#include <string>

#include "examples/render/film.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// Open Image Denoise, version 2 (openimagedenoise.org), which is loaded where it is asked for: not
/// every system has it.
class Denoiser {
 public:
  /// `library`: its file; "": that of the system. `threads`: 0: as many as there are. Null, with an
  /// error, where it is not there, or of another version.
  static std::unique_ptr<Denoiser> load(const std::string& library, int threads,
                                        Diagnostics& diagnostics);
  ~Denoiser();
  Denoiser(const Denoiser&) = delete;
  Denoiser& operator=(const Denoiser&) = delete;

  /// "Open Image Denoise 2.5.1"
  const std::string& name() const { return name_; }

  /// Denoises a picture by its passes "albedo" and "normal", which it has. What it was is its pass
  /// "noisy" then; Film::denoised_by says who did it. False, with an error, where that failed.
  bool denoise(Film& film, Diagnostics& diagnostics) const;

 private:
  struct Library;

  explicit Denoiser(std::unique_ptr<Library> library);

  std::unique_ptr<Library> library_;
  std::string name_;
};

}  // namespace nacre::host
