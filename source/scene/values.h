// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_values_h
#define tetradapt_scene_values_h

#include "tetradapt/scene/words.h"

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tetradapt::scene
{
  /** How the text of a parameter becomes a value of type T and back; reading
   * what write() wrote gives the same value. */
  template <class T>
  struct Codec
  {
    std::string expected; ///< what a text must be, for messages and documentation
    std::function<bool(const std::string &, T &)> read; ///< false: the text does not fit
    std::function<std::string(const T &)>         write;
  };

  /** @p text without white space at its ends. */
  std::string
  trim(const std::string &text);

  /** The trimmed parts of @p text between @p separator; none for a blank text. */
  std::vector<std::string>
  split(const std::string &text, char separator);

  /** The shortest text that reads back as @p value. */
  std::string
  text_of(double value);

  /** One word per enumeration value, as words() lists them. */
  template <class E>
  Codec<E>
  word_codec()
  {
    std::string expected;
    for (const auto &entry : words(E()))
      expected += (expected.empty() ? "one of '" : ", '") + entry.second + "'";
    return {expected,
            [](const std::string &text, E &value) {
              for (const auto &entry : words(E()))
                if (entry.second == text)
                  {
                    value = entry.first;
                    return true;
                  }
              return false;
            },
            [](const E &value) { return word(value); }};
  }

  /** Several of the words of an enumeration, separated by commas. */
  template <class E>
  Codec<std::vector<E>>
  words_codec()
  {
    const Codec<E> one      = word_codec<E>();
    std::string    expected = "a list, separated by commas, of ";
    for (const auto &entry : words(E()))
      expected += (expected.back() == ' ' ? "'" : ", '") + entry.second + "'";
    return {expected,
            [one](const std::string &text, std::vector<E> &value) {
              value.clear();
              for (const auto &part : split(text, ','))
                {
                  value.emplace_back();
                  if (!one.read(part, value.back()))
                    return false;
                }
              return true;
            },
            [one](const std::vector<E> &value) {
              std::string text;
              for (const E element : value)
                text += (text.empty() ? "" : ", ") + one.write(element);
              return text;
            }};
  }

  Codec<double>
  number_codec();
  Codec<unsigned int>
  count_codec();
  Codec<unsigned long>
  long_count_codec();
  Codec<long>
  integer_codec();
  Codec<bool>
  yes_no_codec();
  Codec<std::string>
  text_codec(const std::string &expected = "a text");
  Codec<dealii::Point<3>>
  point_codec();
  Codec<std::vector<double>>
  numbers_codec();
  Codec<std::vector<int>>
  ids_codec();
  Codec<std::vector<std::string>>
  names_codec();
  Codec<std::vector<std::string>>
  paths_codec();
  Codec<std::array<unsigned int, 3>>
  brick_codec();
  Codec<std::vector<std::array<unsigned int, 3>>>
  bricks_codec();
  /** Axis-parallel boxes, each by two opposite corners. */
  Codec<std::vector<std::pair<dealii::Point<3>, dealii::Point<3>>>>
  boxes_codec();
  /** A number, or nothing. */
  Codec<std::optional<double>>
  optional_number_codec();
  /** Three components, each a number or "free". */
  Codec<std::array<std::optional<double>, 3>>
  motion_codec();
  /** A point, or nothing. */
  Codec<std::optional<dealii::Point<3>>>
  optional_point_codec();
  /** The two ends of a line, or nothing. */
  Codec<std::optional<std::pair<dealii::Point<3>, dealii::Point<3>>>>
  optional_line_codec();
  /** Full names of parameters, separated by "&". */
  Codec<std::vector<std::string>>
  parameter_names_codec();
  /** Cases separated by "|", in each values separated by "&". */
  Codec<std::vector<std::vector<std::string>>>
  cases_codec();
  /** Expressions separated by semicolons. */
  Codec<std::vector<std::string>>
  expression_list_codec();
  /** Texts separated by "|". */
  Codec<std::vector<std::string>>
  labels_codec();
  /** Components of a displacement: "all", or some of x, y, z. */
  Codec<std::array<bool, 3>>
  components_codec();
  /** One expression or three of them, separated by semicolons. */
  Codec<std::vector<std::string>>
  value_codec();

  /** @p N expressions separated by semicolons; if @p may_be_blank, also none
   * (N empty texts). */
  template <std::size_t N>
  Codec<std::array<std::string, N>>
  expressions_codec(bool may_be_blank)
  {
    return {std::to_string(N) + " expressions separated by semicolons"
              + (may_be_blank ? ", or nothing" : ""),
            [may_be_blank](const std::string &text, std::array<std::string, N> &value) {
              const auto parts = split(text, ';');
              if (parts.empty() && may_be_blank)
                value.fill("");
              else if (parts.size() != N)
                return false;
              else
                std::copy(parts.begin(), parts.end(), value.begin());
              return true;
            },
            [](const std::array<std::string, N> &value) {
              std::string text;
              for (std::size_t i = 0; i < N && !value[0].empty(); ++i)
                text += (i == 0 ? "" : "; ") + value[i];
              return text;
            }};
  }
} // namespace tetradapt::scene

#endif
