// SPDX-License-Identifier: AGPL-3.0-or-later
#include "surface_file.h"

#include "tetradapt/core/exceptions.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace tetradapt::geometry
{
  namespace
  {
    /** Messages stay readable if a file without line ends is one word. */
    std::string
    shortened(const std::string &word)
    {
      return word.size() <= 40 ? word : word.substr(0, 40) + "...";
    }
  } // namespace

  void
  refuse_line(const std::string &file, const unsigned int line, const std::string &problem)
  {
    throw core::InputError("The surface file '" + file + "', line " + std::to_string(line) + ": "
                           + problem);
  }

  unsigned long
  announced_count(const std::string  &file,
                  const unsigned int  line,
                  const std::string  &word,
                  const unsigned long n_bytes)
  {
    char        *end   = nullptr;
    const double count = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != '\0' || !(count >= 0.) || count != std::floor(count))
      refuse_line(file, line, "'" + shortened(word) + "' is not a number of points or polygons.");
    // No point or polygon takes less than three bytes.
    if (count > static_cast<double>(n_bytes) / 3. + 1.)
      refuse_line(file,
                  line,
                  shortened(word)
                    + " points or polygons are announced, more than a file of its size can hold.");
    return static_cast<unsigned long>(count);
  }

  std::vector<std::string>
  words_of(const std::string &line)
  {
    std::istringstream       stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
      words.push_back(word);
    return words;
  }

  double
  number_of(const std::string &file, const unsigned int line, const std::string &word)
  {
    char        *end   = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (end == word.c_str() || *end != '\0' || !std::isfinite(value))
      refuse_line(file, line, "'" + shortened(word) + "' is not a finite number.");
    return value;
  }

  unsigned long
  point_of(const std::string  &file,
           const unsigned int  line,
           const std::string  &word,
           const unsigned long n_points)
  {
    const double number = number_of(file, line, word);
    if (!(number >= 0. && number < static_cast<double>(n_points)) || number != std::floor(number))
      refuse_line(file,
                  line,
                  "'" + shortened(word) + "' is not the number of a point; there are "
                    + std::to_string(n_points) + ", counted from 0.");
    return static_cast<unsigned long>(number);
  }
} // namespace tetradapt::geometry
