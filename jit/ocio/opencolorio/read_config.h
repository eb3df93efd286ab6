#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <exception>
#include <mutex>
#include <string>

namespace nacre {

namespace ocio = OCIO_NAMESPACE;

/// No logging while it lives. The level belongs to the whole process, so it is lent to
/// one of us at a time.
class Quiet {
 public:
  Quiet() : lock_(mutex()), level_(ocio::GetLoggingLevel()) {
    ocio::SetLoggingLevel(ocio::LOGGING_LEVEL_NONE);
  }
  ~Quiet() { ocio::SetLoggingLevel(level_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }

  std::lock_guard<std::mutex> lock_;
  ocio::LoggingLevel level_;
};

/// As its files are now. Throws what OpenColorIO throws.
ocio::ConstConfigRcPtr read_config(const std::string& path);

/// OpenColorIO's reason on one line.
std::string reason(const std::exception& exception);

}  // namespace nacre
