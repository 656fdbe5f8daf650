// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/msh4_sections.h"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace tetradapt::io
{
  namespace
  {
    constexpr std::int64_t max_int = std::numeric_limits<int>::max();
  }



  std::int64_t
  Msh4Sections::integer(const char *what)
  {
    if (binary)
      return content.scanner.binary<std::int32_t>(what);
    return content.scanner.integer(what, -max_int, max_int);
  }



  std::size_t
  Msh4Sections::size(const char       *what,
                     const std::size_t bytes_each_ascii,
                     const std::size_t bytes_each)
  {
    if (!binary)
      return content.scanner.count(what, bytes_each_ascii);
    const auto n = content.scanner.binary<std::uint64_t>(what);
    content.scanner.check_count(n, what, bytes_each);
    return n;
  }



  std::int64_t
  Msh4Sections::tag(const char *what)
  {
    return binary ? content.scanner.binary<std::int64_t>(what) : content.scanner.integer(what);
  }



  double
  Msh4Sections::number(const char *what)
  {
    return binary ? content.scanner.binary<double>(what) : content.scanner.number(what);
  }



  void
  Msh4Sections::read_entities()
  {
    FileScanner &scanner = content.scanner;
    scanner.line();
    scanner.set_binary(binary);
    std::array<std::size_t, 4> n_entities;
    for (std::size_t &n : n_entities)
      n = size("the number of entities", 10, 36);

    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < n_entities[dimension]; ++i)
        {
          const int entity = integer("an entity's number");
          for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k)
            number("an entity's bound");
          const std::size_t n_physical = size("the number of physical groups", 2, 4);
          for (std::size_t k = 0; k < n_physical; ++k)
            {
              // A negative number only says that the group looks the other way.
              const std::int64_t physical = std::abs(integer("a physical group"));
              if (physical > max_int)
                scanner.fail("the physical group " + std::to_string(physical)
                             + " is out of range.");
              if (k > 0 && dimension >= 2)
                scanner.fail(std::string(dimension == 2 ? "surface " : "volume ")
                             + std::to_string(entity) + " is in more than one physical group ("
                             + std::to_string(physical_groups[{dimension, entity}]) + " and "
                             + std::to_string(physical)
                             + "). Put each surface and each volume into one group.");
              physical_groups[{dimension, entity}] = physical;
            }
          if (dimension > 0)
            {
              const std::size_t n_bounding = size("the number of bounding entities", 2, 4);
              for (std::size_t k = 0; k < n_bounding; ++k)
                integer("a bounding entity");
            }
        }
    scanner.set_binary(false);
  }



  void
  Msh4Sections::read_nodes()
  {
    FileScanner &scanner = content.scanner;
    scanner.line();
    scanner.set_binary(binary);
    const std::size_t n_blocks = size("the number of blocks", 8, 20);
    const std::size_t n_nodes  = size("the number of nodes", 8, 32);
    tag("the smallest node number");
    tag("the largest node number");
    content.reserve(n_nodes);

    std::size_t n_read = 0;
    for (std::size_t block = 0; block < n_blocks; ++block)
      {
        const int dimension = integer("the dimension of an entity");
        integer("an entity's number");
        const int parametric = integer("whether nodes have parameters");
        if (dimension < 0 || dimension > 3 || parametric < 0 || parametric > 1)
          scanner.fail("a block of nodes of dimension " + std::to_string(dimension)
                       + " with the parametric flag " + std::to_string(parametric) + ".");
        const std::size_t n = size("the number of nodes in a block", 8, 32);
        for (std::size_t i = 0; i < n; ++i)
          content.add_node_tag(tag("a node's number"));
        for (std::size_t i = 0; i < n; ++i)
          {
            Point<3> point;
            for (unsigned int d = 0; d < 3; ++d)
              point[d] = number("a node's coordinate");
            content.builder.points().push_back(point);
            for (int d = 0; d < parametric * dimension; ++d)
              number("a node's parameter");
          }
        n_read += n;
      }
    if (n_read != n_nodes)
      scanner.fail("the blocks hold " + std::to_string(n_read) + " nodes instead of "
                   + std::to_string(n_nodes) + ".");
    scanner.set_binary(false);
  }



  void
  Msh4Sections::read_elements()
  {
    FileScanner &scanner = content.scanner;
    scanner.line();
    scanner.set_binary(binary);
    const std::size_t n_blocks   = size("the number of blocks", 8, 20);
    const std::size_t n_elements = size("the number of elements", 4, 16);
    tag("the smallest element number");
    tag("the largest element number");

    std::size_t n_read = 0;
    for (std::size_t block = 0; block < n_blocks; ++block)
      {
        const int          dimension = integer("the dimension of an entity");
        const int          entity    = integer("an entity's number");
        const int          type      = integer("an element's type");
        const std::size_t  n         = size("the number of elements in a block", 4, 16);
        const auto         group     = physical_groups.find({dimension, entity});
        const int          physical  = group == physical_groups.end() ? 0 : group->second;
        const unsigned int n_nodes   = content.n_nodes(type);

        std::array<std::int64_t, 10> nodes;
        for (std::size_t i = 0; i < n; ++i)
          {
            tag("an element's number");
            for (unsigned int k = 0; k < n_nodes; ++k)
              nodes[k] = tag("an element's node");
            content.add_element(type, nodes.data(), physical);
          }
        n_read += n;
      }
    if (n_read != n_elements)
      scanner.fail("the blocks hold " + std::to_string(n_read) + " elements instead of "
                   + std::to_string(n_elements) + ".");
    scanner.set_binary(false);
  }
} // namespace tetradapt::io
