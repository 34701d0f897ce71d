#include "comment_words.hpp"

#include "lines.hpp"

#include <algorithm>

namespace overturn {

bool begins_with_number(std::string_view word)
{
    return word.find_first_of("0123456789.") == 0;
}

bool introduces_unit(std::string_view word)
{
    return is_one_of(word, {"in", "of", "unit", "units"});
}

bool is_acceleration(std::string_view word)
{
    return is_one_of(word, {"a", "acc", "accel", "accn", "acceleration", "accelerations"});
}

bool is_length(std::string_view word)
{
    return is_one_of(word, {"mm", "cm", "dm", "m", "km", "ft", "feet", "foot", "inch", "inches",
                            "cms", "mms", "mps", "cmps", "mmps"});
}

bool has_size_of_gravity(std::string_view number)
{
    return number.starts_with("9.8") || number.starts_with("980") || number.starts_with("981");
}

bool is_contents(std::string_view word)
{
    return is_acceleration(word) ||
           is_one_of(word, {"amplitude", "amplitudes", "col", "column", "columns", "data",
                            "history", "motion", "record", "sample", "samples", "series", "signal",
                            "trace", "value", "values"});
}

bool is_velocity_or_displacement(std::string_view word)
{
    return word.starts_with("velocit") || word.starts_with("displacement") ||
           is_one_of(word, {"vel", "disp", "displ"});
}

bool is_column(std::string_view word)
{
    return is_contents(word) || is_velocity_or_displacement(word) ||
           is_one_of(word,
                     {"t",      "time",   "times",      "x",           "y",        "z",
                      "n",      "s",      "e",          "w",           "ns",       "ew",
                      "ud",     "up",     "north",      "east",        "vertical", "horizontal",
                      "h1",     "h2",     "component",  "comp",        "channel",  "ch",
                      "ground", "radial", "transverse", "longitudinal"});
}

bool is_peak(std::string_view word)
{
    return is_one_of(word, {"pga", "pgv", "pgd", "psa", "sa", "peak", "max", "maximum", "min",
                            "minimum", "cav", "arias"});
}

bool is_of_instrument(std::string_view word)
{
    return is_one_of(word, {"clip", "full", "gain", "lsb", "noise", "range", "resolution",
                            "sensitivity", "threshold", "trigger"});
}

bool is_of_wave_or_fault(std::string_view word)
{
    return is_peak(word) ||
           is_one_of(word, {"shear", "wave", "swave", "vs", "vs30", "fault", "slip", "rupture",
                            "initial", "final", "residual", "permanent", "static"});
}

bool is_sensitivity(std::string_view word)
{
    return word.find('/') != word.npos &&
           is_one_of(word.substr(0, word.find('/')),
                     {"v", "mv", "uv", "volt", "volts", "count", "counts", "lsb", "bit", "bits",
                      "digit", "digits"});
}

bool is_factor(std::string_view word)
{
    return word.find_first_of("*/") == 0 ||
           is_one_of(word,
                     {"percent", "milli", "micro", "tenth", "tenths", "hundredths", "thousandths",
                      "divided", "factor", "multiplied", "multiply", "scale", "scaled", "times"});
}

bool is_unit(std::string_view word)
{
    const std::size_t end = std::min(word.find_first_of("/*0123456789"), word.size());
    const std::string_view name = word.substr(0, end);
    return is_one_of(name, {"g",    "gs",     "gn",    "gravity", "gravities", "gal",  "gals",
                            "mgal", "mg",     "ug",    "cmss",    "mss",       "si",   "mks",
                            "cgs",  "metric", "count", "counts",  "volt",      "volts"}) ||
           word.starts_with("n/kg") || word.starts_with("in/s") || word.find("/s2") != word.npos ||
           (is_length(name) && is_factor(word.substr(end)));
}

std::string_view unit_of_word(std::string_view word)
{
    word.remove_prefix(std::min(word.find_first_not_of("0123456789."), word.size()));
    if (!is_unit(word) || is_acceleration(word.substr(0, word.find('/')))) {
        word.remove_prefix(std::min(word.find('/') + 1, word.size()));
    }
    return word.ends_with('g') && is_acceleration(word.substr(0, word.size() - 1)) ? "g" : word;
}

bool is_length_or_velocity(std::string_view word)
{
    const std::string_view unit = unit_of_word(word);
    return unit.find("/s2") == unit.npos &&
           (is_length(unit.substr(0, unit.find_first_of("/*0123456789"))) ||
            unit.starts_with("in/s"));
}

} // namespace overturn
