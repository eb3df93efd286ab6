#include "jit/tune/measure.h"

#include "jit/tune/examination.h"
#include "runtime/report_stop.h"

namespace nacre {

std::optional<MeasuredError> measure_error(const TuneSubject& subject, const TuneOptions& options,
                                           Diagnostics& diagnostics) {
  const auto exactly = compile_exactly(subject, options.shader, diagnostics);
  if (exactly == nullptr) return std::nullopt;
  const auto examination =
      examine(subject, *exactly, options.points, options.recorded.get(), 1, diagnostics);
  const auto is_stopped = [&] {
    return report_if_due(options.shader.compile.stop, "measuring an error",
                         {.file = {}, .path = subject.text()}, diagnostics);
  };
  if (!examination) {
    is_stopped();
    return std::nullopt;
  }
  // Interpreted: the same bits as compiled, at once.
  ShaderOptions asked = options.shader;
  asked.compile.backend = Backend::interpreter;
  asked.compile.asynchronous = false;
  Diagnostics again;  // What is said of the document has been.
  const auto trial = TuneTrial::compile(subject, asked, again);
  if (trial == nullptr) {
    for (const Diagnostic& each : again.all()) diagnostics.add(each);
    return std::nullopt;
  }
  const Columns found = trial->results(examination->points);
  if (is_stopped()) return std::nullopt;
  return MeasuredError{error_of(found, examination->exact, options.metric), examination->about};
}

}  // namespace nacre
