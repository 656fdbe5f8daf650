// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/scene/parameter_printer.h"

#include "binder.h"
#include "declarations.h"

#include <algorithm>
#include <ostream>
#include <sstream>

namespace tetradapt::scene
{
  namespace
  {
    /** Writes @p text in lines of at most 92 letters, each beginning with @p start. */
    void
    print_wrapped(std::ostream &stream, const std::string &text, const std::string &start)
    {
      std::istringstream words(text);
      std::string        line, word;
      while (words >> word)
        {
          if (!line.empty() && start.size() + line.size() + word.size() > 91)
            {
              stream << start << line << '\n';
              line.clear();
            }
          line += (line.empty() ? "" : " ") + word;
        }
      if (!line.empty())
        stream << start << line << '\n';
    }

    void
    print_prm(std::ostream      &stream,
              const SectionTree &section,
              const bool         documented,
              const std::string &indent)
    {
      std::size_t width = 0;
      for (const auto &entry : section.entries)
        width = std::max(width, entry.name.size());
      for (const auto &entry : section.entries)
        {
          if (documented)
            {
              print_wrapped(stream, entry.documentation, indent + "# ");
              print_wrapped(stream, "Expected: " + entry.expected + ".", indent + "# ");
            }
          stream << indent << "set " << entry.name
                 << std::string(documented ? 0 : width - entry.name.size(), ' ') << " ="
                 << (entry.default_value.empty() ? "" : " ") << entry.default_value << '\n';
          if (documented && &entry != &section.entries.back())
            stream << '\n';
        }
      for (const auto &child : section.sections)
        {
          if (indent.empty())
            stream << '\n';
          if (documented && indent.empty())
            print_wrapped(stream, section_documentation(child.name), "# ");
          stream << indent << "subsection " << child.name << '\n';
          print_prm(stream, child, documented, indent + "  ");
          stream << indent << "end\n";
        }
    }

    /** A table must not contain a bar or a tag. */
    std::string
    markdown_text(const std::string &text)
    {
      std::string safe;
      for (const char c : text)
        if (c == '|')
          safe += "\\|";
        else if (c == '<')
          safe += "&lt;";
        else
          safe += c;
      return safe;
    }

    void
    print_markdown(std::ostream &stream, const SectionTree &section, const std::string &name)
    {
      if (!name.empty())
        stream << "\n## " << markdown_text(name) << "\n\n";
      if (name.find('/') == std::string::npos && !name.empty())
        stream << section_documentation(name) << '\n';
      if (!section.entries.empty())
        stream << "\n| Parameter | Default | Meaning | Expected |\n|---|---|---|---|\n";
      for (const auto &entry : section.entries)
        stream << "| " << entry.name << " | "
               << (entry.default_value.empty() ? "" : "`" + entry.default_value + "`") << " | "
               << markdown_text(entry.documentation) << " | " << markdown_text(entry.expected)
               << " |\n";
      for (const auto &child : section.sections)
        print_markdown(stream, child, name.empty() ? child.name : name + "/" + child.name);
    }
  } // namespace

  void
  print_parameters(std::ostream &stream, const ParameterFormat format)
  {
    using Handler = dealii::ParameterHandler;
    Handler prm;
    declare(template_scene(), prm);
    switch (format)
      {
      case ParameterFormat::prm:
        stream << "# All parameters of Tetradapt with their defaults.\n";
        print_prm(stream, section_tree(prm), true, "");
        break;
      case ParameterFormat::json:
        prm.print_parameters(stream,
                             Handler::OutputStyle(Handler::JSON | Handler::KeepDeclarationOrder));
        break;
      case ParameterFormat::markdown:
        stream << "# Parameters\n\nA scene sets what differs from these defaults.\n";
        print_markdown(stream, section_tree(prm), "");
        break;
      }
  }

  std::string
  effective_parameters(const Scene &scene)
  {
    dealii::ParameterHandler prm;
    declare(scene, prm);
    std::ostringstream stream;
    stream << "# The complete input of the scene " << scene.file << '\n';
    print_prm(stream, section_tree(prm), false, "");
    return stream.str();
  }
} // namespace tetradapt::scene
