// SPDX-License-Identifier: AGPL-3.0-or-later
#include "scene_sink.h"

#include "renamed.h"
#include "values.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/scene/nearest_names.h"

#include <algorithm>
#include <cctype>

namespace tetradapt::scene
{
  namespace fs = std::filesystem;

  namespace
  {
    [[noreturn]] void
    refuse(const Place &place, const std::string &text)
    {
      throw core::InputError(place.text() + ": " + text);
    }

    [[noreturn]] void
    refuse_nesting(const Place &place, const std::string &text)
    {
      throw NestingError(place.text() + ": " + text);
    }

    /** Letters (of any language), digits, blanks and - _ . make a name. */
    bool
    is_name(const std::string &name)
    {
      return std::all_of(name.begin(), name.end(), [](const unsigned char c) {
        return c >= 128 || std::isalnum(c) || c == ' ' || c == '-' || c == '_' || c == '.';
      });
    }

    /** @throws core::InputError if @p name is one of an earlier version of the program: then
     * much else that seems to be wrong only follows from old names. */
    void
    refuse_old_name(const std::string &name, const Place &place, Mistakes &mistakes)
    {
      const std::string text = renamed_to(name);
      if (text.empty())
        return;
      mistakes.give_up();
      refuse(place, text);
    }

    bool
    is_number(const std::string &text)
    {
      double number;
      return number_codec().read(text, number);
    }
  } // namespace

  SceneSink::SceneSink(Scene &scene, dealii::ParameterHandler &prm, Mistakes &mistakes)
    : scene(scene), prm(prm), mistakes(mistakes)
  {
    dealii::ParameterHandler all;
    declare(template_scene(), all);
    valid = section_tree(all);
  }

  void
  SceneSink::enter(const SectionPath &path, const Place &place)
  {
    const SectionTree *parent = find({path.begin(), path.end() - 1});
    const std::string &name   = path.back();
    if (parent->section(name) == nullptr)
      refuse_section(*parent, path, place);
    if (path.size() == 2)
      enter_block(path, place);
    scene.places.emplace(full_name(path), place.text());
  }

  void
  SceneSink::set(const SectionPath &path,
                 const std::string &name,
                 const std::string &value,
                 const Place       &place)
  {
    const SectionTree *section = find(path);
    if (section->entry(name) == nullptr)
      refuse_entry(*section, path, name, place);
    const std::string whole         = full_name(path, name);
    const auto [previous, is_first] = lines.emplace(place.file + "\n" + whole, place.line);
    if (!is_first && place.line > 0)
      refuse(place,
             whole + " was already set in line " + std::to_string(previous->second)
               + ". Remove one of the two.");
    scene.places[whole]     = place.text();
    places_of_values[whole] = place;
    if (!try_to_set(path, name, value))
      // Nothing else hangs on a number; on a word such as a Type much does.
      mistakes.add_message(place.text() + ": " + whole + ": '" + value
                             + "' does not fit. Expected: " + section->entry(name)->expected + ".",
                           whole,
                           is_number(section->entry(name)->default_value)
                             || section->entry(name)->expected == optional_number_codec().expected);
  }

  void
  SceneSink::set_override(const std::string &text)
  {
    const Place       place{"command line", 0};
    const auto        equals = text.find('=');
    const SectionPath path   = split(text.substr(0, equals), '/');
    if (equals == std::string::npos || path.empty() || std::count(path.begin(), path.end(), "") > 0)
      refuse(place, "'" + text + "' is incomplete. Write --set 'Section/Name=value'.");
    const std::string value = trim(text.substr(equals + 1));
    if (value.find_first_of("#\n\r") != std::string::npos
        || (!value.empty() && value.back() == '\\'))
      refuse(place,
             "'" + value
               + "' has a character that a parameter file cannot hold: #, a line end, or a "
                 "backslash in the end. Remove it.");
    set_existing(path, value, place);
  }

  void
  SceneSink::set_case(const VariationParameters &variation, const unsigned int number)
  {
    const std::string start = "Study/" + variation.name + "/";
    for (std::size_t i = 0; i < variation.parameters.size(); ++i)
      {
        const std::string &name      = variation.parameters[i];
        const SectionPath  path      = split(name, '/');
        const auto [other, is_first] = owners.emplace(full_name(path), variation.name);
        const Place names            = places_of_values.at(start + "Parameters");
        if (!is_first)
          refuse(names,
                 start + "Parameters: " + name + " is also varied by Study/" + other->second
                   + ". Remove one of the two.");
        if (std::count(path.begin(), path.end(), "") > 0)
          refuse(
            names,
            start + "Parameters: '" + name
              + "' is not the full name of a parameter, such as Adaptivity/Refinement indicator.");
        check_name(path, names);
        if (lines.count("command line\n" + full_name(path)) > 0)
          refuse(names,
                 start + "Parameters: " + full_name(path)
                   + " is varied by the study and also set on the command line. Set Study/"
                   + variation.name + "/Values there, or run the one scene.");
        const Place place = places_of_values.at(start + "Values");
        lines.erase(place.file + "\n" + full_name(path)); // setting it again is meant
        set_existing(path, variation.cases[number][i], place);
      }
  }

  fs::path
  SceneSink::folder_of(const std::string &parameter) const
  {
    const auto entry = places_of_values.find(parameter);
    return entry == places_of_values.end() || entry->second.line == 0
             ? fs::path()
             : fs::path(entry->second.file).parent_path();
  }

  bool
  SceneSink::try_to_set(const SectionPath &path, const std::string &name, const std::string &value)
  {
    bool fits = true;
    for (const auto &section_name : path)
      prm.enter_subsection(section_name);
    try
      {
        prm.set(name, value);
      }
    catch (const dealii::ExceptionBase &)
      {
        fits = false;
      }
    for (std::size_t i = 0; i < path.size(); ++i)
      prm.leave_subsection();
    return fits;
  }

  void
  SceneSink::check_name(SectionPath path, const Place &place)
  {
    refuse_old_name(full_name(path), place, mistakes);
    const std::string name = path.back();
    path.pop_back();
    for (std::size_t n = 1; n <= path.size(); ++n)
      find_existing({path.begin(), path.begin() + n}, place);
    if (find(path)->entry(name) == nullptr)
      refuse_entry(*find(path), path, name, place);
  }

  void
  SceneSink::set_existing(SectionPath path, const std::string &value, const Place &place)
  {
    check_name(path, place);
    const std::string name = path.back();
    path.pop_back();
    set(path, name, value, place);
  }

  const SectionTree *
  SceneSink::find(const SectionPath &path) const
  {
    const SectionTree *section = &valid;
    for (const auto &name : path)
      section = section->section(name);
    return section;
  }

  void
  SceneSink::find_existing(const SectionPath &path, const Place &place)
  {
    const SectionTree *parent = find({path.begin(), path.end() - 1});
    if (parent->section(path.back()) == nullptr)
      refuse_section(*parent, path, place);
    if (path.size() != 2 || scene.places.count(full_name(path)) > 0)
      return;
    std::vector<std::string> names;
    const std::string        start = path[0] + "/";
    for (const auto &entry : scene.places)
      if (entry.first.compare(0, start.size(), start) == 0
          && entry.first.find('/', start.size()) == std::string::npos)
        names.push_back(entry.first.substr(start.size()));
    refuse(place,
           "the scene has no '" + path.back() + "' in " + path[0] + ". "
             + (names.empty() ? "It has no block there." : suggest(path.back(), names)));
  }

  void
  SceneSink::enter_block(const SectionPath &path, const Place &place)
  {
    const std::string whole         = full_name(path);
    const auto [previous, is_first] = lines.emplace(place.file + "\n" + whole + "/", place.line);
    if (!is_first)
      refuse(place,
             whole + " was already described in line " + std::to_string(previous->second)
               + ". Give this one another name.");
    if (!is_name(path[1]))
      refuse(place,
             "'" + path[1] + "' cannot be a name in " + path[0]
               + ". Use letters, digits, blanks, '-', '_' and '.'.");
    if (valid.section(path[1]) != nullptr)
      refuse_nesting(place,
                     "'" + path[1] + "' inside of " + path[0]
                       + ": it is a section of its own. Is an 'end' missing above?");
    if (scene.places.count(whole) == 0)
      add_block(path[0], path[1], scene, prm);
  }

  void
  SceneSink::refuse_section(const SectionTree &parent, const SectionPath &path, const Place &place)
  {
    refuse_old_name(full_name(path), place, mistakes);
    const std::string &name  = path.back();
    const std::string  where = full_name({path.begin(), path.end() - 1});
    std::string        text
      = "there is no subsection '" + name + "'" + (where.empty() ? "" : " in " + where) + ". ";
    if (!where.empty() && valid.section(name) != nullptr)
      refuse_nesting(place, text + "It is a section of its own: is an 'end' missing above?");
    if (parent.entry(name) != nullptr)
      refuse(place, text + "But there is a parameter: write 'set " + name + " = ...'.");
    if (parent.sections.empty())
      refuse_nesting(place, text + "It has none. Is an 'end' missing above?");
    const auto near = nearest_names(name, parent.section_names());
    if (!near.empty()) // what is told as missing there may be here
      mistakes.mark_unreadable((where.empty() ? "" : where + "/") + near[0]);
    refuse(place, text + suggest(name, parent.section_names()));
  }

  void
  SceneSink::refuse_entry(const SectionTree &section,
                          const SectionPath &path,
                          const std::string &name,
                          const Place       &place) const
  {
    refuse_old_name(full_name(path, name), place, mistakes);
    std::string text
      = "unknown parameter '" + name + "'"
        + (path.empty() ? " outside of all subsections. " : " in " + full_name(path) + ". ");
    if (path.size() == 1 && has_named_blocks(path[0]))
      refuse(place,
             text + "Parameters of " + path[0]
               + " go into a subsection with a name of your choice: 'subsection name', 'set " + name
               + " = ...', 'end'.");
    if (!nearest_names(name, section.entry_names()).empty())
      refuse(place, text + suggest(name, section.entry_names()));
    for (const auto &other : valid.sections)
      {
        const SectionTree &block = has_named_blocks(other.name) ? other.sections[0] : other;
        if (block.entry(name) != nullptr)
          refuse(place,
                 text + "It belongs to subsection " + other.name
                   + (has_named_blocks(other.name) ? "/" + name_placeholder : "") + ".");
      }
    refuse(place, text + suggest(name, section.entry_names()));
  }
} // namespace tetradapt::scene
