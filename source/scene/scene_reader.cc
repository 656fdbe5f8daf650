// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/scene_reader.h"

#include "declarations.h"
#include "prm_lines.h"
#include "renamed.h"
#include "values.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/scene/nearest_names.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

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

    /** Letters (of any language), digits, blanks and - _ . make a name. */
    bool
    is_name(const std::string &name)
    {
      return std::all_of(name.begin(), name.end(), [](const unsigned char c) {
        return c >= 128 || std::isalnum(c) || c == ' ' || c == '-' || c == '_' || c == '.';
      });
    }

    /** Fills a ParameterHandler and a scene's blocks from what a file says. */
    class SceneSink : public PrmSink
    {
    public:
      SceneSink(Scene &scene, dealii::ParameterHandler &prm) : scene(scene), prm(prm)
      {
        dealii::ParameterHandler all;
        declare(template_scene(), all);
        valid = section_tree(all);
      }

      void
      enter(const SectionPath &path, const Place &place) override
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
      set(const SectionPath &path,
          const std::string &name,
          const std::string &value,
          const Place       &place) override
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
        for (const auto &section_name : path)
          prm.enter_subsection(section_name);
        try
          {
            prm.set(name, value);
          }
        catch (const dealii::ExceptionBase &)
          {
            refuse(place,
                   whole + ": '" + value
                     + "' does not fit. Expected: " + section->entry(name)->expected + ".");
          }
        for (std::size_t i = 0; i < path.size(); ++i)
          prm.leave_subsection();
        scene.places[whole]     = place.text();
        places_of_values[whole] = place;
      }

      /** Sets a "Section/Name=value" of the command line. */
      void
      set_override(const std::string &text)
      {
        const Place       place{"command line", 0};
        const auto        equals = text.find('=');
        const SectionPath path   = split(text.substr(0, equals), '/');
        if (equals == std::string::npos || path.empty()
            || std::count(path.begin(), path.end(), "") > 0)
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

      /** Sets what @p variation varies to the values of its case @p number, as if they
       * were written in the file where its Values are. */
      void
      set_case(const VariationParameters &variation, const unsigned int number)
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
              refuse(names,
                     start + "Parameters: '" + name
                       + "' is not the full name of a parameter, such as Adaptivity/Refinement "
                         "indicator.");
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

      /** The folder that relative names of files in @p parameter count from. */
      fs::path
      folder_of(const std::string &parameter) const
      {
        const auto entry = places_of_values.find(parameter);
        return entry == places_of_values.end() || entry->second.line == 0
                 ? fs::path()
                 : fs::path(entry->second.file).parent_path();
      }

    private:
      /** @throws InputError if @p path is not that of a parameter in a section that the
       * file has. */
      void
      check_name(SectionPath path, const Place &place)
      {
        refuse_old_name(full_name(path), place);
        const std::string name = path.back();
        path.pop_back();
        for (std::size_t n = 1; n <= path.size(); ++n)
          find_existing({path.begin(), path.begin() + n}, place);
        if (find(path)->entry(name) == nullptr)
          refuse_entry(*find(path), path, name, place);
      }

      /** Sets the parameter whose section and name @p path holds; its section must be in
       * the file. */
      void
      set_existing(SectionPath path, const std::string &value, const Place &place)
      {
        check_name(path, place);
        const std::string name = path.back();
        path.pop_back();
        set(path, name, value, place);
      }

      /** The declared section at @p path, whose names have been checked. */
      const SectionTree *
      find(const SectionPath &path) const
      {
        const SectionTree *section = &valid;
        for (const auto &name : path)
          section = section->section(name);
        return section;
      }

      /** @throws InputError if the file has no section or block @p path. */
      void
      find_existing(const SectionPath &path, const Place &place)
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
      enter_block(const SectionPath &path, const Place &place)
      {
        const std::string whole = full_name(path);
        const auto [previous, is_first]
          = lines.emplace(place.file + "\n" + whole + "/", place.line);
        if (!is_first)
          refuse(place,
                 whole + " was already described in line " + std::to_string(previous->second)
                   + ". Give this one another name.");
        if (!is_name(path[1]))
          refuse(place,
                 "'" + path[1] + "' cannot be a name in " + path[0]
                   + ". Use letters, digits, blanks, '-', '_' and '.'.");
        if (valid.section(path[1]) != nullptr)
          refuse(place,
                 "'" + path[1] + "' inside of " + path[0]
                   + ": it is a section of its own. Is an 'end' missing above?");
        if (scene.places.count(whole) == 0)
          add_block(path[0], path[1], scene, prm);
      }

      static void
      refuse_old_name(const std::string &name, const Place &place)
      {
        const std::string text = renamed_to(name);
        if (!text.empty())
          refuse(place, text);
      }

      [[noreturn]] void
      refuse_section(const SectionTree &parent, const SectionPath &path, const Place &place) const
      {
        refuse_old_name(full_name(path), place);
        const std::string &name  = path.back();
        const std::string  where = full_name({path.begin(), path.end() - 1});
        std::string        text
          = "there is no subsection '" + name + "'" + (where.empty() ? "" : " in " + where) + ". ";
        if (!where.empty() && valid.section(name) != nullptr)
          text += "It is a section of its own: is an 'end' missing above?";
        else if (parent.entry(name) != nullptr)
          text += "But there is a parameter: write 'set " + name + " = ...'.";
        else if (!parent.sections.empty())
          text += suggest(name, parent.section_names());
        else
          text += "It has none. Is an 'end' missing above?";
        refuse(place, text);
      }

      [[noreturn]] void
      refuse_entry(const SectionTree &section,
                   const SectionPath &path,
                   const std::string &name,
                   const Place       &place) const
      {
        refuse_old_name(full_name(path, name), place);
        std::string text
          = "unknown parameter '" + name + "'"
            + (path.empty() ? " outside of all subsections. " : " in " + full_name(path) + ". ");
        if (path.size() == 1 && has_named_blocks(path[0]))
          refuse(place,
                 text + "Parameters of " + path[0]
                   + " go into a subsection with a name of your choice: 'subsection name', 'set "
                   + name + " = ...', 'end'.");
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

      Scene                              &scene;
      dealii::ParameterHandler           &prm;
      SectionTree                         valid;
      std::map<std::string, unsigned int> lines; ///< of "file\nparameter"
      std::map<std::string, Place>        places_of_values;
      std::map<std::string, std::string>  owners; ///< variation of each parameter that varies
    };

    std::string
    absolute(const std::string &file, const fs::path &folder)
    {
      if (file.empty())
        return file;
      const fs::path path(file);
      return fs::absolute(path.is_absolute() ? path : folder / path).lexically_normal().string();
    }
  } // namespace

  namespace
  {
    /** Calls @p action; an error gets the place at which the user wrote what is to blame. */
    template <typename Action>
    void
    with_places(const Scene &scene, const Action &action)
    {
      try
        {
          action();
        }
      catch (const core::InputError &error)
        {
          const std::string placed = scene.with_place(error.what());
          throw core::InputError(placed == error.what() ? scene.file + ": " + placed : placed);
        }
    }

    /** What the study varies, as the file and the command line say so far. */
    std::vector<VariationParameters>
    read_variations(const Scene &scene, dealii::ParameterHandler &prm)
    {
      Scene whole = scene;
      with_places(scene, [&] {
        parse(whole, prm);
        for (const auto &variation : whole.variations)
          variation.check();
      });
      return whole.variations;
    }

    Scene
    read(const std::string               &file,
         const std::vector<std::string>  &overrides,
         const std::vector<unsigned int> &cases)
    {
      Scene scene;
      scene.file = file;
      scene.name = fs::path(file).stem().string();
      if (scene.name == "." || scene.name == "..")
        throw core::InputError("'" + file
                               + "' has no name before its ending, by which its "
                                 "results could be called. Rename the file.");
      dealii::ParameterHandler prm;
      declare(scene, prm);
      SceneSink sink(scene, prm);
      read_prm(file, sink);
      for (const auto &text : overrides)
        sink.set_override(text);
      if (!cases.empty())
        {
          const auto variations = read_variations(scene, prm);
          for (std::size_t i = 0; i < cases.size(); ++i)
            sink.set_case(variations.at(i), cases[i]);
        }
      with_places(scene, [&] {
        parse(scene, prm);
        if (!cases.empty())
          scene.variations.clear();
        for (auto &name : scene.mesh.files)
          name = absolute(name, sink.folder_of("Mesh/Files"));
        scene.mesh.size_field = absolute(scene.mesh.size_field, sink.folder_of("Mesh/Size field"));
        scene.mesh.projection_file
          = absolute(scene.mesh.projection_file, sink.folder_of("Mesh/Projection file"));
        scene.reference.file = absolute(scene.reference.file, sink.folder_of("Reference/File"));
        scene.check();
      });
      return scene;
    }
  } // namespace

  Scene
  read_scene(const std::string &file, const std::vector<std::string> &overrides)
  {
    return read(file, overrides, {});
  }

  Scene
  read_study_run(const std::string               &file,
                 const std::vector<std::string>  &overrides,
                 const std::vector<unsigned int> &cases)
  {
    return read(file, overrides, cases);
  }
} // namespace tetradapt::scene
