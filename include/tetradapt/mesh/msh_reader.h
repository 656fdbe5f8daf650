// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_msh_reader_h
#define tetradapt_mesh_msh_reader_h

#include "tetradapt/mesh/file_scanner.h"
#include "tetradapt/mesh/mesh_builder.h"

#include <unordered_map>

namespace tetradapt::mesh
{
  /**
   * Reads a Gmsh file, format 2.0 to 2.2 or 4.1, ASCII or binary. Physical
   * surfaces become boundary ids and named groups, physical volumes regions; an
   * element outside every physical group gets 0. Tetrahedra may be of first
   * or second order (see MeshBuilder::add_quadratic_cell()); points and lines are
   * left out, other elements refused. The result still needs finalize().
   *
   * Format: Gmsh reference manual, "MSH file format".
   */
  TetMesh
  read_msh(const std::string &file);

  /** What both formats share: nodes by their tags, elements by their types. */
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

  /** The sections that format 4.1 writes in its own way. */
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
} // namespace tetradapt::mesh

#endif
