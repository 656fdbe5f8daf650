// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_prm_lines_h
#define tetradapt_scene_prm_lines_h

#include "tetradapt/scene/mistakes.h"

#include <string>
#include <vector>

namespace tetradapt::scene
{
  /** Where something was written. */
  struct Place
  {
    std::string  file; ///< "command line" has no line
    unsigned int line = 0;

    std::string
    text() const
    {
      return line == 0 ? file : file + ":" + std::to_string(line);
    }
  };

  /** Names of the subsections from the outermost one. */
  using SectionPath = std::vector<std::string>;

  /** Names joined by slashes, as messages and the command line write them. */
  std::string
  full_name(const SectionPath &path, const std::string &name = "");

  /** The subsections of a file do not end where they should: what follows cannot be
   * understood. */
  class NestingError : public core::InputError
  {
  public:
    using core::InputError::InputError;
  };

  /** Is told what a parameter file says, in its order. */
  class PrmSink
  {
  public:
    virtual ~PrmSink() = default;

    /** A subsection begins; @p path ends with its name. If it throws an InputError, what is in
     * the subsection is left out. */
    virtual void
    enter(const SectionPath &path, const Place &place)
      = 0;

    /** @p name is set to @p value in the subsection @p path. */
    virtual void
    set(const SectionPath &path,
        const std::string &name,
        const std::string &value,
        const Place       &place)
      = 0;
  };

  /**
   * Reads a parameter file in deal.II's format: `subsection name`, `end`,
   * `set name = value`, `include file`; what follows a # is a comment, and a line
   * that ends with a backslash goes on in the next one. Names of included files
   * count from the folder of the file that includes them.
   *
   * Only lines and nesting are looked at here; what names and values mean is the
   * sink's business. What is wrong, also by what the sink throws, is added to @p mistakes as
   * "file:line: ...", and the reading goes on in the next line; a NestingError ends it.
   */
  void
  read_prm(const std::string &file, PrmSink &sink, Mistakes &mistakes);
} // namespace tetradapt::scene

#endif
