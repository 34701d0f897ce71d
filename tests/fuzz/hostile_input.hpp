// What the program reads, given any bytes. Each entry point takes what the fuzz targets and the
// test of hostile input make up, and hands it to the readers; nothing but the errors that they
// promise may come out of them, and nothing may be computed or written.
#pragma once

#include <string>
#include <string_view>

namespace overturn {

enum class Verdict { accepted, refused };

/// The beginning of the input may be lines "--set KEY=VALUE"; the rest becomes a job file at
/// `path`. A job that is accepted has to come back from its own resolved text.
Verdict use_as_job(std::string_view bytes, const std::string& path);

/// A result file as it may stand at `path`, for overturn info, verify and run.
Verdict use_as_result_file(const std::string& path);

/// The bytes become the file at `path` first.
Verdict use_as_result_file(std::string_view bytes, const std::string& path);

/// The arguments, one to a line.
Verdict use_as_command_line(std::string_view bytes);

} // namespace overturn
