// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_io_msh_content_h
#define tetradapt_io_msh_content_h

#include "tetradapt/io/file_scanner.h"
#include "tetradapt/io/mesh_builder.h"

#include <unordered_map>

namespace tetradapt::io
{
  /** What the two formats of Gmsh files share: nodes by their tags, elements by their types. */
  class MshContent
  {
  public:
    MshContent(FileScanner &scanner, MeshBuilder &builder) : scanner(scanner), builder(builder)
    {
    }

    /** Gives the next point the number @p tag; tags are positive and different. */
    void
    add_node_tag(std::int64_t tag);

    /** Room for this many nodes, which has been checked against the file's size. */
    void
    reserve(std::size_t n_nodes);

    /** Number of nodes of an element; other types than those of read_msh() are
     * refused. */
    unsigned int
    n_nodes(int type) const;

    /** Adds an element, given by the tags of its nodes, of group @p physical. */
    void
    add_element(int type, const std::int64_t *node_tags, int physical);

    FileScanner &scanner;
    MeshBuilder &builder;

  private:
    unsigned int
    node(std::int64_t tag) const;

    unsigned int                                   n_tags = 0;
    std::vector<unsigned int>                      dense; ///< for tags up to 4 times the number
    std::unordered_map<std::int64_t, unsigned int> sparse;
  };
} // namespace tetradapt::io

#endif
