// SPDX-License-Identifier: AGPL-3.0-or-later
#include "values.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace tetradapt::scene
{
  namespace
  {
    /** Reads all of @p text as one number. */
    template <class Number>
    bool
    read_number(const std::string &text, Number &value)
    {
      // from_chars knows no leading plus sign.
      const bool  plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
      const char *end  = text.data() + text.size();
      const auto  done = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
      return done.ec == std::errc() && done.ptr == end;
    }

    bool
    read_double(const std::string &text, double &value)
    {
      // "inf" and "nan" are numbers to from_chars.
      return read_number(text, value) && std::isfinite(value);
    }

    bool
    read_brick(const std::string &text, std::array<unsigned int, 3> &value)
    {
      const auto parts = split(text, 'x');
      if (parts.size() != 3)
        return false;
      for (unsigned int d = 0; d < 3; ++d)
        if (!read_number(parts[d], value[d]))
          return false;
      return true;
    }

    std::string
    write_brick(const std::array<unsigned int, 3> &value)
    {
      return std::to_string(value[0]) + "x" + std::to_string(value[1]) + "x"
             + std::to_string(value[2]);
    }

    /** A list whose elements @p read_one reads and @p write_one writes. */
    template <class T, class Read, class Write>
    Codec<std::vector<T>>
    list_codec(const std::string &expected, const char separator, Read read_one, Write write_one)
    {
      return {expected,
              [=](const std::string &text, std::vector<T> &value) {
                value.clear();
                for (const auto &part : split(text, separator))
                  {
                    T element{};
                    if (!read_one(part, element))
                      return false;
                    value.push_back(element);
                  }
                return true;
              },
              [=](const std::vector<T> &value) {
                std::string text;
                for (const auto &element : value)
                  text
                    += (text.empty() ? "" : std::string(1, separator) + " ") + write_one(element);
                return text;
              }};
    }

    template <class T>
    Codec<T>
    whole_number_codec(const std::string &expected)
    {
      return {expected,
              [](const std::string &text, T &value) { return read_number(text, value); },
              [](const T &value) { return std::to_string(value); }};
    }

    bool
    read_name(const std::string &text, std::string &value)
    {
      value = text;
      return !text.empty();
    }

    std::string
    same(const std::string &text)
    {
      return text;
    }
  } // namespace

  std::string
  trim(const std::string &text)
  {
    const char *blanks = " \t\r\n\v\f";
    const auto  first  = text.find_first_not_of(blanks);
    if (first == std::string::npos)
      return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  std::vector<std::string>
  split(const std::string &text, const char separator)
  {
    std::vector<std::string> parts;
    if (trim(text).empty())
      return parts;
    std::string::size_type start = 0;
    while (true)
      {
        const auto end = text.find(separator, start);
        parts.push_back(trim(text.substr(start, end - start)));
        if (end == std::string::npos)
          return parts;
        start = end + 1;
      }
  }

  std::string
  text_of(const double value)
  {
    std::array<char, 64> buffer;
    const auto           done = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return std::string(buffer.data(), done.ptr);
  }

  Codec<double>
  number_codec()
  {
    return {"a finite number such as 0.5 or 1e-9", read_double, text_of};
  }

  Codec<unsigned int>
  count_codec()
  {
    return whole_number_codec<unsigned int>("a whole number, 0 or larger");
  }

  Codec<unsigned long>
  long_count_codec()
  {
    return whole_number_codec<unsigned long>("a whole number, 0 or larger");
  }

  Codec<long>
  integer_codec()
  {
    return whole_number_codec<long>("a whole number");
  }

  Codec<bool>
  yes_no_codec()
  {
    return {"'yes' or 'no'",
            [](const std::string &text, bool &value) {
              value = text == "yes" || text == "true";
              return value || text == "no" || text == "false";
            },
            [](const bool &value) { return value ? std::string("yes") : std::string("no"); }};
  }

  Codec<std::string>
  text_codec(const std::string &expected)
  {
    return {expected,
            [](const std::string &text, std::string &value) {
              value = text;
              return true;
            },
            same};
  }

  Codec<dealii::Point<3>>
  point_codec()
  {
    return {"three numbers separated by commas, such as 0, 0, 1.5",
            [](const std::string &text, dealii::Point<3> &value) {
              const auto parts = split(text, ',');
              if (parts.size() != 3)
                return false;
              for (unsigned int d = 0; d < 3; ++d)
                if (!read_double(parts[d], value[d]))
                  return false;
              return true;
            },
            [](const dealii::Point<3> &value) {
              return text_of(value[0]) + ", " + text_of(value[1]) + ", " + text_of(value[2]);
            }};
  }

  Codec<std::vector<double>>
  numbers_codec()
  {
    return list_codec<double>("numbers separated by commas", ',', read_double, text_of);
  }

  Codec<std::vector<int>>
  ids_codec()
  {
    return list_codec<int>(
      "whole numbers separated by commas",
      ',',
      [](const std::string &text, int &value) { return read_number(text, value); },
      [](const int value) { return std::to_string(value); });
  }

  Codec<std::vector<std::string>>
  names_codec()
  {
    return list_codec<std::string>("names separated by commas", ',', read_name, same);
  }

  Codec<std::vector<std::string>>
  paths_codec()
  {
    return list_codec<std::string>("file names separated by semicolons", ';', read_name, same);
  }

  Codec<std::array<unsigned int, 3>>
  brick_codec()
  {
    return {"three whole numbers such as 7x7x42", read_brick, write_brick};
  }

  Codec<std::vector<std::array<unsigned int, 3>>>
  bricks_codec()
  {
    return list_codec<std::array<unsigned int, 3>>(
      "a list such as 1x1x7, 2x2x13 of three whole numbers each", ',', read_brick, write_brick);
  }

  Codec<std::array<bool, 3>>
  components_codec()
  {
    return {"'all', or some of x, y, z separated by commas",
            [](const std::string &text, std::array<bool, 3> &value) {
              value.fill(text == "all");
              if (text == "all")
                return true;
              for (const auto &part : split(text, ','))
                {
                  if (part != "x" && part != "y" && part != "z")
                    return false;
                  value[part[0] - 'x'] = true;
                }
              return value[0] || value[1] || value[2];
            },
            [](const std::array<bool, 3> &value) {
              if (value[0] && value[1] && value[2])
                return std::string("all");
              std::string text;
              for (unsigned int c = 0; c < 3; ++c)
                if (value[c])
                  text += (text.empty() ? "" : ", ") + std::string(1, "xyz"[c]);
              return text;
            }};
  }

  Codec<std::vector<std::string>>
  value_codec()
  {
    return {"one expression, or three separated by semicolons",
            [](const std::string &text, std::vector<std::string> &value) {
              value = split(text, ';');
              for (const auto &part : value)
                if (part.empty())
                  return false;
              return value.size() == 1 || value.size() == 3;
            },
            [](const std::vector<std::string> &value) {
              std::string text;
              for (const auto &part : value)
                text += (text.empty() ? "" : "; ") + part;
              return text;
            }};
  }

  Codec<std::vector<std::pair<dealii::Point<3>, dealii::Point<3>>>>
  boxes_codec()
  {
    using Box = std::pair<dealii::Point<3>, dealii::Point<3>>;
    return list_codec<Box>(
      "boxes such as 0, 0, 0 : 1, 1, 2, separated by semicolons",
      ';',
      [](const std::string &text, Box &value) {
        const auto corners = split(text, ':');
        const auto point   = point_codec();
        return corners.size() == 2 && point.read(corners[0], value.first)
               && point.read(corners[1], value.second);
      },
      [](const Box &value) {
        return point_codec().write(value.first) + " : " + point_codec().write(value.second);
      });
  }

  Codec<std::optional<double>>
  optional_number_codec()
  {
    return {"a finite number, or nothing",
            [](const std::string &text, std::optional<double> &value) {
              value.reset();
              if (trim(text).empty())
                return true;
              value = 0.;
              return read_double(text, *value);
            },
            [](const std::optional<double> &value) { return value ? text_of(*value) : ""; }};
  }

  Codec<std::array<std::optional<double>, 3>>
  motion_codec()
  {
    using Motion = std::array<std::optional<double>, 3>;
    return {"three components separated by commas, each a number or 'free', such as 0, free, 0",
            [](const std::string &text, Motion &value) {
              const auto parts = split(text, ',');
              if (parts.size() != 3)
                return false;
              for (unsigned int c = 0; c < 3; ++c)
                {
                  value[c].reset();
                  if (parts[c] != "free" && !read_double(parts[c], value[c].emplace()))
                    return false;
                }
              return true;
            },
            [](const Motion &value) {
              std::string text;
              for (const auto &component : value)
                text += (text.empty() ? "" : ", ") + (component ? text_of(*component) : "free");
              return text;
            }};
  }

  Codec<std::optional<dealii::Point<3>>>
  optional_point_codec()
  {
    return {"three numbers separated by commas, such as 0, 0, 1.5, or nothing",
            [](const std::string &text, std::optional<dealii::Point<3>> &value) {
              value.reset();
              return trim(text).empty() || point_codec().read(text, value.emplace());
            },
            [](const std::optional<dealii::Point<3>> &value) {
              return value ? point_codec().write(*value) : "";
            }};
  }

  Codec<std::optional<std::pair<dealii::Point<3>, dealii::Point<3>>>>
  optional_line_codec()
  {
    using Line = std::optional<std::pair<dealii::Point<3>, dealii::Point<3>>>;
    return {"two points such as 0, 0, 0 : 1, 0, 0, or nothing",
            [](const std::string &text, Line &value) {
              value.reset();
              if (trim(text).empty())
                return true;
              const auto ends = split(text, ':');
              value.emplace();
              return ends.size() == 2 && point_codec().read(ends[0], value->first)
                     && point_codec().read(ends[1], value->second);
            },
            [](const Line &value) {
              return value ? point_codec().write(value->first) + " : "
                               + point_codec().write(value->second)
                           : "";
            }};
  }

  Codec<std::vector<std::string>>
  parameter_names_codec()
  {
    return list_codec<std::string>("names such as Adaptivity/Refinement indicator, separated by &",
                                   '&',
                                   read_name,
                                   same);
  }

  Codec<std::vector<std::vector<std::string>>>
  cases_codec()
  {
    const auto values = list_codec<std::string>("", '&', read_name, same);
    return list_codec<std::vector<std::string>>(
      "cases separated by |, in each as many values as parameters, separated by &",
      '|',
      values.read,
      values.write);
  }

  Codec<std::vector<std::string>>
  labels_codec()
  {
    return list_codec<std::string>("texts separated by |", '|', read_name, same);
  }

  Codec<std::vector<std::string>>
  expression_list_codec()
  {
    return list_codec<std::string>("expressions in x, y, z separated by semicolons, or nothing",
                                   ';',
                                   read_name,
                                   same);
  }
} // namespace tetradapt::scene
