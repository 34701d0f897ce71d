// Readers of the program for arbitrary bytes. Each entry point passes the input of the fuzz targets
// and of the test of hostile input to the readers, which may only throw their documented errors;
// nothing may be computed or written.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace overturn {

enum class Response { accepted, refused };

/// Throws std::logic_error, which no reader throws.
inline void demand(bool condition, const std::string& otherwise)
{
    if (!condition) {
        throw std::logic_error(otherwise);
    }
}

/// The input may begin with lines "--set KEY=VALUE"; the rest becomes a job file at `path`. Reading
/// the resolved text of an accepted job must give the same job.
Response use_as_job(std::string_view bytes, const std::string& path);

/// The input may begin with lines "unit NAME" and "time_step NUMBER"; the rest becomes a recorded
/// motion at `path`. An accepted one must be as the header of the reader promises.
Response use_as_record(std::string_view bytes, const std::string& path);

/// Reads the input as a table of blocks, and the blocks in it.
Response use_as_table(std::string_view bytes);

/// Reads any file at `path` as a result file, like overturn info, verify and run.
Response use_as_result_file(const std::string& path);

/// Writes the bytes to the file at `path` first.
Response use_as_result_file(std::string_view bytes, const std::string& path);

/// Reads the arguments, one per line.
Response use_as_command_line(std::string_view bytes);

} // namespace overturn
