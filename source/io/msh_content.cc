// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/msh_content.h"

namespace tetradapt::io
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;



    /** Gmsh's mid-edge nodes of a tetrahedron, as we have them in edge_vertices. */
    constexpr std::array<unsigned int, 10> tet10_order{{0, 1, 2, 3, 4, 5, 6, 7, 9, 8}};



    const char *
    type_name(const int type)
    {
      switch (type)
        {
        case 3:
        case 10:
        case 16:
          return "quadrangles";
        case 5:
        case 12:
        case 17:
          return "hexahedra";
        case 6:
        case 13:
        case 18:
          return "prisms";
        case 7:
        case 14:
        case 19:
          return "pyramids";
        default:
          return "elements of another kind or of third order";
        }
    }
  } // namespace



  void
  MshContent::reserve(const std::size_t n_nodes)
  {
    builder.points().reserve(n_nodes);
    dense.reserve(n_nodes + 1);
  }



  void
  MshContent::add_node_tag(const std::int64_t tag)
  {
    if (tag < 1)
      scanner.fail("a node has the number " + std::to_string(tag)
                   + "; node numbers must be positive.");
    bool is_new;
    if (static_cast<std::size_t>(tag) < 4 * static_cast<std::size_t>(n_tags) + 1000)
      {
        if (static_cast<std::size_t>(tag) >= dense.size())
          dense.resize(tag + 1, none);
        is_new     = dense[tag] == none && sparse.count(tag) == 0;
        dense[tag] = n_tags;
      }
    else
      is_new = sparse.emplace(tag, n_tags).second;
    if (!is_new)
      scanner.fail("two nodes have the number " + std::to_string(tag) + ".");
    ++n_tags;
  }



  unsigned int
  MshContent::node(const std::int64_t tag) const
  {
    if (tag >= 0 && static_cast<std::size_t>(tag) < dense.size() && dense[tag] != none)
      return dense[tag];
    if (const auto found = sparse.find(tag); found != sparse.end())
      return found->second;
    scanner.fail("an element names node " + std::to_string(tag) + ", which does not exist.");
  }



  unsigned int
  MshContent::n_nodes(const int type) const
  {
    switch (type)
      {
      case 15: // point
        return 1;
      case 1: // lines of order one to five
        return 2;
      case 8:
        return 3;
      case 26:
        return 4;
      case 27:
        return 5;
      case 28:
        return 6;
      case 2: // triangles
        return 3;
      case 9:
        return 6;
      case 4: // tetrahedra
        return 4;
      case 11:
        return 10;
      default:
        scanner.fail("the mesh has " + std::string(type_name(type)) + " (type "
                     + std::to_string(type)
                     + "); only tetrahedra and triangles of first or second order can be used.");
      }
  }



  void
  MshContent::add_element(const int type, const std::int64_t *node_tags, const int physical)
  {
    std::array<unsigned int, 10> nodes{};
    if (type == 4 || type == 2 || type == 9)
      for (unsigned int i = 0; i < (type == 4 ? 4 : 3); ++i)
        nodes[i] = node(node_tags[i]);

    if (type == 4)
      builder.add_cell({{nodes[0], nodes[1], nodes[2], nodes[3]}}, physical);
    else if (type == 2 || type == 9)
      builder.add_face({{nodes[0], nodes[1], nodes[2]}}, physical);
    else if (type == 11)
      {
        for (unsigned int i = 0; i < 10; ++i)
          nodes[i] = node(node_tags[tet10_order[i]]);
        builder.add_quadratic_cell(nodes, physical);
      }
  }
} // namespace tetradapt::io
