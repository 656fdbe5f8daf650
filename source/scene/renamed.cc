// SPDX-License-Identifier: AGPL-3.0-or-later
#include "renamed.h"

#include <map>

namespace tetradapt::scene
{
  namespace
  {
    const std::map<std::string, std::string> &
    new_names()
    {
      static const std::map<std::string, std::string> names{
        {"Truth", "Exact solution"},
        {"Truth/Energy", "Exact solution/Strain energy"},
        {"Exact solution/Energy", "Exact solution/Strain energy"},
        {"Adaptivity/Driver", "Adaptivity/Refinement indicator"},
        {"Adaptivity/Route", "Adaptivity/Size control"},
        {"Solver/Algebraic fraction", "Solver/Solver error fraction"}};
      return names;
    }
  } // namespace

  std::string
  renamed_to(const std::string &full_name)
  {
    const auto        whole   = new_names().find(full_name);
    const std::string section = full_name.substr(0, full_name.find('/'));
    std::string       today;
    if (whole != new_names().end())
      today = whole->second;
    else if (const auto part = new_names().find(section); part != new_names().end())
      today = part->second + full_name.substr(section.size());
    else
      return "";
    const bool is_energy = today == "Exact solution/Strain energy";
    return "'" + full_name + "' is now called '" + today + "'"
           + (is_energy ? ", and its value is half of the former one" : "")
           + ". contrib/convert_scene converts scenes of earlier versions.";
  }
} // namespace tetradapt::scene
