// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/exceptions.h"

#include "surface_file.h"

#include <cctype>
#include <filesystem>
#include <fstream>

namespace tetradapt::geometry
{
  namespace
  {
    /** Reads the lines of a file that are neither empty nor comments. */
    class OffLines
    {
    public:
      explicit OffLines(const std::string &file) : file(file), stream(file, std::ios::binary)
      {
      }

      /** The words of the next line; @p wanted says in the message what is missing if
       * there is none. */
      std::vector<std::string>
      next(const std::string &wanted)
      {
        for (std::string line; std::getline(stream, line);)
          {
            ++number;
            auto words = words_of(line.substr(0, line.find('#')));
            if (!words.empty())
              return words;
          }
        refuse_line(file, number, "the file ends before " + wanted + ".");
      }

      const std::string &file;
      unsigned int       number = 0; ///< of the last line, from 1

    private:
      std::ifstream stream;
    };

    /** How many numbers a line of a point has at least, by the file's first word. */
    unsigned int
    numbers_per_point(const std::string &keyword)
    {
      unsigned int n = 3;
      for (const auto &[part, count] :
           {std::pair<const char *, unsigned int>{"ST", 2}, {"C", 3}, {"N", 3}})
        if (keyword.find(part) != std::string::npos)
          n += count;
      return n;
    }

    void
    check_point(const OffLines                 &lines,
                const std::vector<std::string> &words,
                const unsigned int              wanted)
    {
      if (words.size() < wanted)
        refuse_line(lines.file,
                    lines.number,
                    "a point with " + std::to_string(words.size()) + " numbers, where "
                      + std::to_string(wanted) + " are needed.");
      for (const std::string &word : words)
        number_of(lines.file, lines.number, word);
    }

    void
    check_polygon(const OffLines                 &lines,
                  const std::vector<std::string> &words,
                  const unsigned long             n_points)
    {
      const double n = number_of(lines.file, lines.number, words[0]);
      if (!(n >= 1.) || n > static_cast<double>(words.size() - 1))
        refuse_line(lines.file,
                    lines.number,
                    "a polygon of " + words[0] + " points with " + std::to_string(words.size() - 1)
                      + " numbers.");
      const auto n_corners = static_cast<std::size_t>(n);
      for (std::size_t i = 1; i <= n_corners; ++i)
        point_of(lines.file, lines.number, words[i], n_points);
      for (std::size_t i = n_corners + 1; i < words.size(); ++i)
        number_of(lines.file, lines.number, words[i]); // a colour
    }
  } // namespace

  void
  check_off_file(const std::string &file)
  {
    const unsigned long      n_bytes = std::filesystem::file_size(file);
    OffLines                 lines(file);
    std::vector<std::string> words   = lines.next("the numbers of points and polygons");
    std::string              keyword = "OFF"; // may be left out
    if (words[0].find_first_not_of("0123456789") != std::string::npos)
      {
        keyword = words[0];
        if (keyword.size() < 3 || keyword.compare(keyword.size() - 3, 3, "OFF") != 0
            || keyword.substr(0, keyword.size() - 3).find_first_not_of("STCN") != std::string::npos)
          refuse_line(
            file,
            lines.number,
            "an .off file begins with OFF, COFF, NOFF or STOFF; other kinds are not read.");
        words.erase(words.begin());
        if (words.empty())
          words = lines.next("the numbers of points and polygons");
      }
    if (words[0] == "BINARY")
      refuse_line(file, lines.number, "binary .off files are not read. Write it as text.");
    if (words.size() < 3)
      refuse_line(file, lines.number, "the numbers of points, polygons and edges are missing.");
    const unsigned long n_points = announced_count(file, lines.number, words[0], n_bytes);
    const unsigned long n_faces  = announced_count(file, lines.number, words[1], n_bytes);
    const unsigned int  wanted   = numbers_per_point(keyword);
    for (unsigned long i = 0; i < n_points; ++i)
      check_point(lines, lines.next("point " + std::to_string(i)), wanted);
    for (unsigned long i = 0; i < n_faces; ++i)
      check_polygon(lines, lines.next("polygon " + std::to_string(i)), n_points);
  }
} // namespace tetradapt::geometry
