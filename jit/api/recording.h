#pragma once

#include <nacre/nacre.h>

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/diagnostic.h"
#include "runtime/node/node_call.h"
#include "runtime/program/recorder.h"

namespace nacre::api {

/// What a host's function is recording into while it runs, on its thread: checks what comes from
/// outside before the Recorder, which trusts its callers, sees it. A fault is an error at the
/// node, and what it would have given is a zero.
class Recording {
 public:
  /// From here to its end `current()` is this one. All must outlive it.
  Recording(Recorder& recorder, Diagnostics& diagnostics, const SourceLocation& where);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// That of the function of a host's which this thread is in; null outside of one.
  static Recording* current();

  nacre_recorder* handle() { return reinterpret_cast<nacre_recorder*>(&recorder_); }
  Recorder& recorder() { return recorder_; }
  bool has_failed() const { return failed_; }

  /// The value that a host means; a zero of `type`, after an error, for one that is not of this
  /// recording, cannot be seen from here, or has another type.
  Ref take(nacre_value value, Scalar type, const char* what);
  nacre_value give(Ref ref);

  nacre_value record(nacre_operation operation, const nacre_value* operands, std::size_t count,
                     std::uint32_t immediate);

  void begin_if(nacre_value mask);
  nacre_value merge(nacre_value inside, nacre_value outside);
  void end_if();
  void begin_loop(nacre_value mask, std::uint32_t bound);
  nacre_value carry(nacre_value initial);
  nacre_value next(nacre_value carry, nacre_value value);
  void again(nacre_value goes_on);
  void end_loop();
  nacre_value keep(nacre_value value);
  /// A zero, after an error, for a name that has another type already.
  /// @{
  Ref read_channel(const std::string& name, Scalar type);
  Ref read_slot(const std::string& name, nacre_value literal);
  /// @}

  void fail(const std::string& message, const std::string& expected = {});

 private:
  /// A region that the host has opened, and how far it has come.
  struct Region {
    bool is_loop = false;
    bool has_ended = false;  ///< Only merges, or what ends a loop, may follow.
    bool has_again = false;
    std::vector<Ref> carries = {};
    std::size_t nexts = 0;
  };
  /// The innermost region, if it is of that kind; null after an error.
  Region* open(bool is_loop, const char* what);
  bool may_record(const char* what);
  void finish_carries(Region& region);
  void close_region();

  Recorder& recorder_;
  Diagnostics& diagnostics_;
  const SourceLocation& where_;
  Recording* const outer_;
  std::vector<Region> regions_;
  bool failed_ = false;
};

Scalar scalar_of_number(int type);

}  // namespace nacre::api

/// See nacre/record.h.
struct nacre_node {
  nacre::NodeCall& call;
  nacre::api::Recording& recording;
};
