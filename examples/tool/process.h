#pragma once

#include <functional>
#include <string>

namespace nacre::tool {

/// Sets the process up for the rest of its life: closed standard streams stay closed to
/// us but get numbers that no other file can take; writing to a pipe nobody reads and
/// beyond the size that files may have (ulimit -f) fails instead of killing; and what is
/// thrown where nobody catches it, for want of memory or threads, ends it with one line.
void prepare_process();

/// For work that takes and frees the same memory again and again: the process keeps what is
/// freed, else the system gives it anew, page by page. For the rest of its life.
void keep_freed_memory();

/// A subcommand's status: what `run` gives, or that of problems, said, if it throws for
/// want of memory or threads. `file` is the document.
int guarded(const std::string& file, const std::function<int()>& run);

/// A promise (stop.h) is kept: the name is printed, unless `quiet`.
void file_is_written(const std::string& file, bool quiet);

/// Writes out what was printed. The status given, or that of problems, with a line that
/// says why, if not all of it could be written.
int finish_output(int status);

}  // namespace nacre::tool
