// SPDX-License-Identifier: AGPL-3.0-or-later
#include "prm_lines.h"

#include "values.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/scene/nearest_names.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tetradapt::scene
{
  namespace fs = std::filesystem;

  std::string
  full_name(const SectionPath &path, const std::string &name)
  {
    std::string text;
    for (const auto &section : path)
      text += (text.empty() ? "" : "/") + section;
    return name.empty() ? text : (text.empty() ? name : text + "/" + name);
  }

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

    /** Number of bytes of the UTF-8 character at @p i, 0 if there is none. */
    unsigned int
    utf8_length(const std::string &text, const std::size_t i)
    {
      const auto         c = static_cast<unsigned char>(text[i]);
      const unsigned int n = c < 0x80                  ? 1
                             : (c >= 0xC2 && c < 0xE0) ? 2
                             : (c >= 0xE0 && c < 0xF0) ? 3
                             : (c >= 0xF0 && c < 0xF5) ? 4
                                                       : 0;
      for (unsigned int k = 1; k < n; ++k)
        if (i + k >= text.size() || (static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80)
          return 0;
      return n;
    }

    /** Refuses what no text file holds: readers and writers further on rely on it. */
    void
    check_text(const std::string &line, const Place &place)
    {
      constexpr std::size_t longest = 1u << 20;
      if (line.size() > longest)
        refuse(place,
               "this line has " + std::to_string(line.size())
                 + " bytes. Is it a parameter file? Its lines have at most "
                 + std::to_string(longest) + ".");
      for (std::size_t i = 0; i < line.size();)
        {
          const unsigned int length = utf8_length(line, i);
          const auto         c      = static_cast<unsigned char>(line[i]);
          if (length == 0 || (c < 32 && c != '\t' && c != '\r'))
            refuse_nesting(place,
                           "this is not text in UTF-8 (byte " + std::to_string(c) + " at position "
                             + std::to_string(i + 1)
                             + "). Is it a parameter file? Save it as UTF-8.");
          i += length;
        }
    }

    std::string
    content_of(const std::string &file, const std::string &prefix)
    {
      std::error_code error;
      const auto      status = fs::status(file, error);
      if (error && error != std::errc::no_such_file_or_directory)
        throw core::InputError(prefix + "'" + file + "' cannot be opened: " + error.message()
                               + ". Correct the name of the parameter file.");
      if (!fs::exists(status))
        throw core::InputError(prefix + "there is no file '" + file
                               + "'. Correct the name of the parameter file.");
      // A pipe may have nobody who writes to it, and a device no end.
      if (!fs::is_regular_file(status))
        throw core::InputError(prefix + "'" + file
                               + "' is a folder, a pipe or a device, not a file.");
      std::ifstream stream(file, std::ios::binary);
      if (!stream)
        throw core::InputError(prefix + "'" + file + "' cannot be opened. Check its permissions.");
      // A parameter file has some kilobytes; a mesh given by mistake has more.
      constexpr std::size_t limit = 4u << 20;
      std::string           content(limit + 1, '\0');
      stream.read(content.data(), content.size());
      content.resize(stream.gcount());
      if (content.size() > limit)
        throw core::InputError(prefix + "'" + file
                               + "' is larger than 4 MiB: this is not a parameter file.");
      return content;
    }

    class Reader
    {
    public:
      Reader(PrmSink &sink, Mistakes &mistakes) : sink(sink), mistakes(mistakes)
      {
      }

      void
      read(const std::string &file, const std::string &prefix)
      {
        if (++n_files > 1000)
          throw core::InputError(prefix + "more than 1000 files are included.");
        std::istringstream lines(content_of(file, prefix));
        const std::string  identity = fs::weakly_canonical(file).string();
        if (std::find(open_files.begin(), open_files.end(), identity) != open_files.end())
          throw core::InputError(prefix + "'" + file
                                 + "' includes itself, directly or through others. Remove one "
                                   "of the include lines.");
        open_files.push_back(identity);
        const std::size_t depth = open.size();
        read_lines(lines, file, depth);
        if (open.size() > depth)
          refuse_nesting(
            open.back(),
            "subsection '" + path.back()
              + "' has no end. Add a line 'end' where it is finished; every subsection "
                "needs its own.");
        open_files.pop_back();
      }

    private:
      void
      read_lines(std::istream &lines, const std::string &file, const std::size_t depth)
      {
        std::string  physical, logical;
        unsigned int n = 0, first = 1;
        bool         continued = false;
        while (std::getline(lines, physical))
          {
            ++n;
            if (n == 1 && physical.compare(0, 3, "\xEF\xBB\xBF") == 0)
              physical.erase(0, 3);
            check_text(physical, {file, n});
            physical = trim(physical.substr(0, physical.find('#')));
            if (!continued)
              {
                logical.clear();
                first = n;
              }
            continued = !physical.empty() && physical.back() == '\\';
            if (continued)
              physical.pop_back();
            logical += physical;
            if (!continued && !logical.empty())
              read_line(trim(logical), {file, first}, depth);
          }
        if (continued)
          refuse_nesting({file, n}, "the last line ends with a backslash, but no line follows.");
      }

      /** Notes what @p action throws; the part @p name cannot be relied on then. */
      void
      attempt(const std::string &name, const std::function<void()> &action)
      {
        try
          {
            action();
          }
        catch (const NestingError &)
          {
            throw;
          }
        catch (const core::InputError &error)
          {
            mistakes.add_message(error.what(), name, false);
          }
      }

      void
      read_line(const std::string &line, const Place &place, const std::size_t depth)
      {
        const auto        blank   = line.find_first_of(" \t");
        const std::string keyword = line.substr(0, blank);
        const std::string rest    = blank == std::string::npos ? "" : trim(line.substr(blank));
        if (keyword == "subsection")
          read_subsection(rest, place);
        else if (keyword == "end")
          read_end(rest, place, depth);
        else if (!is_left_out())
          attempt(full_name(path), [&]() {
            if (keyword == "set")
              read_set(rest, place);
            else if (keyword == "include")
              read_include(rest, place);
            else
              refuse_keyword(keyword, line, place);
          });
      }

      /** Whether the present line is in a subsection that the sink refused. */
      bool
      is_left_out() const
      {
        return left_out > 0;
      }

      void
      read_subsection(const std::string &name, const Place &place)
      {
        SectionPath inner = path;
        inner.push_back(name);
        bool refused = true;
        if (!is_left_out())
          attempt(full_name(inner), [&]() {
            if (name.empty())
              refuse(place, "this subsection has no name. Write 'subsection name'.");
            sink.enter(inner, place);
            refused = false;
          });
        path = inner;
        open.push_back(place);
        if (refused && !is_left_out())
          left_out = open.size();
      }

      void
      read_end(const std::string &rest, const Place &place, const std::size_t depth)
      {
        if (!rest.empty())
          attempt(full_name(path), [&]() {
            refuse(place, "'" + rest + "' follows 'end'. Write 'end' alone on its line.");
          });
        if (open.size() <= depth)
          refuse_nesting(place, "this 'end' ends no subsection. Remove it, or a line above it.");
        if (left_out == open.size())
          left_out = 0;
        path.pop_back();
        open.pop_back();
      }

      [[noreturn]] static void
      refuse_keyword(const std::string &keyword, const std::string &line, const Place &place)
      {
        const std::vector<std::string> keywords{"subsection", "end", "set", "include"};
        const std::string              text = "'" + line
                                 + "' begins with none of subsection, end, set and include. "
                                 + suggest(keyword, keywords);
        const auto near = nearest_names(keyword, keywords);
        if (!near.empty() && (near[0] == "subsection" || (near[0] == "end" && keyword == line)))
          refuse_nesting(place, text);
        refuse(place, text);
      }

      void
      read_include(const std::string &rest, const Place &place)
      {
        if (rest.empty())
          refuse(place, "write 'include' and the name of a file.");
        const fs::path name(rest);
        const fs::path included
          = name.is_absolute() ? name : fs::path(place.file).parent_path() / name;
        try
          {
            read(included.lexically_normal().string(), place.text() + ": ");
          }
        catch (const core::InputError &)
          {
            mistakes.give_up(); // who knows what that file says
            throw;
          }
      }

      void
      read_set(const std::string &rest, const Place &place)
      {
        const auto        equals = rest.find('=');
        const std::string name   = trim(rest.substr(0, equals));
        if (equals == std::string::npos || name.empty())
          refuse(place, "'set " + rest + "' is incomplete. Write 'set name = value'.");
        sink.set(path, name, trim(rest.substr(equals + 1)), place);
      }

      PrmSink                 &sink;
      Mistakes                &mistakes;
      SectionPath              path;
      std::vector<Place>       open; ///< where the subsections of path begin
      std::vector<std::string> open_files;
      unsigned int             n_files  = 0;
      std::size_t              left_out = 0; ///< open subsections up to the one left out; 0: none
    };
  } // namespace

  void
  read_prm(const std::string &file, PrmSink &sink, Mistakes &mistakes)
  {
    try
      {
        Reader(sink, mistakes).read(file, "");
      }
    catch (const core::InputError &error)
      {
        mistakes.add_message(error.what(), "");
        mistakes.give_up();
      }
  }
} // namespace tetradapt::scene
