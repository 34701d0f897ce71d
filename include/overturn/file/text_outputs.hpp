// The text files that overturn writes: the sidecar OUT.h5.json, and tables of answers as
// comma-separated values. An older file of the same kind is replaced atomically, any other file is
// not. All functions throw Error. Those that expect a place are to be called before the
// computation: the folder may be missing or not writable, or the name too long or that of another
// file.
#pragma once

#include <string>
#include <string_view>

namespace overturn {

/// A column of every table of answers, by which it is known.
inline constexpr std::string_view column_of_answers = "topples_from";

void expect_place_for_answers(const std::string& path);
void write_answers(const std::string& path, std::string_view text);

/// The beginning of every sidecar, by which it is known.
inline constexpr std::string_view sidecar_beginning = "{\n  \"program_version\": ";

/// Whether a file that is replaced is the old or the new one after a power failure, too. Syncing
/// may wait for what other programs have written.
enum class Syncing { no, yes };

/// The sidecar is called result_path + ".json".
void expect_place_for_sidecar(const std::string& result_path);
void write_sidecar(const std::string& result_path, std::string_view text,
                   Syncing syncing = Syncing::yes);

} // namespace overturn
