// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_msh4_sections_h
#define tetradapt_io_msh4_sections_h

#include "tetradapt/io/msh_content.h"

namespace tetradapt::io
{
  /** The sections that format 4.1 of Gmsh files writes in its own way. The word
   * $Entities, $Nodes or $Elements has been read, the end mark is not. */
  class Msh4Sections
  {
  public:
    Msh4Sections(MshContent &content, bool binary) : content(content), binary(binary)
    {
    }

    void
    read_entities();
    void
    read_nodes();
    void
    read_elements();

  private:
    std::int64_t
    integer(const char *what);
    std::size_t
    size(const char *what, std::size_t bytes_each_ascii, std::size_t bytes_each);
    std::int64_t
    tag(const char *what);
    double
    number(const char *what);

    MshContent                        &content;
    bool                               binary;
    std::map<std::pair<int, int>, int> physical_groups; ///< of (dimension, entity)
  };
} // namespace tetradapt::io

#endif
