// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/nearest_names.h"

#include <algorithm>
#include <cctype>

namespace tetradapt::scene
{
  namespace
  {
    std::string
    lower(std::string text)
    {
      for (char &c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      return text;
    }

    std::string
    quoted_list(const std::vector<std::string> &names, const std::string &last)
    {
      std::string text;
      for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "'" : i + 1 == names.size() ? last + "'" : ", '") + names[i] + "'";
      return text;
    }
  } // namespace

  unsigned int
  edit_distance(const std::string &first, const std::string &second)
  {
    const std::string a = lower(first), b = lower(second);
    // Rows i-2, i-1 and i of the table of distances between beginnings.
    std::vector<unsigned int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
      row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
      {
        before.swap(above);
        above.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
          {
            row[j] = std::min(
              {above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
              row[j] = std::min(row[j], before[j - 2] + 1);
          }
      }
    return row[b.size()];
  }

  std::vector<std::string>
  nearest_names(const std::string &name, const std::vector<std::string> &valid)
  {
    // No name is so long, and comparing takes as long as both are.
    if (name.size() > 1000)
      return {};
    std::vector<std::pair<unsigned int, std::string>> near;
    for (const auto &candidate : valid)
      {
        const unsigned int limit    = std::max<std::size_t>(2, candidate.size() / 3);
        const unsigned int distance = edit_distance(name, candidate);
        // One that is the beginning of the other is near whatever its length.
        const std::size_t common = std::min(name.size(), candidate.size());
        const bool        begins
          = common >= 3 && lower(name).compare(0, common, lower(candidate), 0, common) == 0;
        if ((distance <= limit && distance < candidate.size()) || begins)
          near.emplace_back(std::min(distance, begins ? limit : distance), candidate);
      }
    std::stable_sort(near.begin(), near.end(), [](const auto &a, const auto &b) {
      return a.first < b.first;
    });
    if (near.size() > 3)
      near.resize(3);
    std::vector<std::string> names;
    for (const auto &entry : near)
      names.push_back(entry.second);
    return names;
  }

  std::string
  suggest(const std::string &name, const std::vector<std::string> &valid)
  {
    const auto near = nearest_names(name, valid);
    if (!near.empty())
      return "Did you mean " + quoted_list(near, " or ") + "?";
    if (valid.empty())
      return "There is no valid name here.";
    return "Valid names are " + quoted_list(valid, " and ") + ".";
  }
} // namespace tetradapt::scene
