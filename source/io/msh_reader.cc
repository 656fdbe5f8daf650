// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/msh_reader.h"

#include "tetradapt/io/msh4_sections.h"

#include <limits>

namespace tetradapt::io
{
  namespace
  {
    constexpr int max_int = std::numeric_limits<int>::max();

    /** $PhysicalNames, the same in both formats and never binary. */
    void
    read_physical_names(FileScanner &scanner, MeshBuilder &builder)
    {
      const std::size_t n = scanner.count("the number of physical names", 5);
      for (std::size_t i = 0; i < n; ++i)
        {
          const int              dimension = scanner.integer("the dimension of a group", 0, 3);
          const int              id   = scanner.integer("the number of a group", -max_int, max_int);
          const std::string_view rest = trimmed(scanner.line());
          if (rest.size() < 2 || rest.front() != '"' || rest.back() != '"')
            scanner.fail(excerpt(rest) + " stands where a name in double quotes is expected.");
          const std::string name(rest.substr(1, rest.size() - 2));
          if (dimension == 2)
            builder.name_boundary(id, name);
          else if (dimension == 3)
            builder.name_region(id, name);
        }
    }



    void
    read_nodes_2(MshContent &content, const bool binary)
    {
      FileScanner      &scanner = content.scanner;
      const std::size_t n       = scanner.count("the number of nodes", binary ? 28 : 8);
      content.reserve(n);
      scanner.line();
      scanner.set_binary(binary);
      for (std::size_t i = 0; i < n; ++i)
        {
          content.add_node_tag(binary ? scanner.binary<std::int32_t>("a node's number")
                                      : scanner.integer("a node's number"));
          Point<3> point;
          for (unsigned int d = 0; d < 3; ++d)
            point[d] = binary ? scanner.binary<double>("a node's coordinate")
                              : scanner.number("a node's coordinate");
          content.builder.points().push_back(point);
        }
      scanner.set_binary(false);
    }



    /** The tags and nodes of one element of format 2. */
    void
    read_element_2(MshContent        &content,
                   const bool         binary,
                   const int          type,
                   const unsigned int n_tags)
    {
      FileScanner &scanner = content.scanner;
      const auto   integer = [&](const char *what) -> std::int64_t {
        return binary ? scanner.binary<std::int32_t>(what) : scanner.integer(what);
      };
      int physical = 0;
      for (unsigned int t = 0; t < n_tags; ++t)
        {
          const std::int64_t tag = integer("an element's tag");
          if (t == 0 && (tag < -max_int || tag > max_int))
            scanner.fail("the physical group " + std::to_string(tag) + " is out of range.");
          if (t == 0)
            physical = tag;
        }
      std::array<std::int64_t, 10> nodes;
      const unsigned int           n_nodes = content.n_nodes(type);
      for (unsigned int i = 0; i < n_nodes; ++i)
        nodes[i] = integer("an element's node");
      content.add_element(type, nodes.data(), physical);
    }



    void
    read_elements_2(MshContent &content, const bool binary)
    {
      FileScanner      &scanner = content.scanner;
      const std::size_t n       = scanner.count("the number of elements", 8);
      scanner.line();
      if (!binary)
        {
          for (std::size_t i = 0; i < n; ++i)
            {
              scanner.integer("an element's number");
              const int          type   = scanner.integer("an element's type", 0, max_int);
              const unsigned int n_tags = scanner.integer("the number of tags", 0, 1000);
              read_element_2(content, false, type, n_tags);
            }
          return;
        }

      scanner.set_binary(true);
      for (std::size_t i = 0; i < n;)
        {
          const int          type    = scanner.binary<std::int32_t>("an element's type");
          const std::int32_t n_block = scanner.binary<std::int32_t>("the number of elements");
          const std::int32_t n_tags  = scanner.binary<std::int32_t>("the number of tags");
          if (n_block <= 0 || static_cast<std::size_t>(n_block) > n - i)
            scanner.fail("a block of " + std::to_string(n_block) + " elements, but "
                         + std::to_string(n - i) + " are left.");
          if (n_tags < 0 || n_tags > 1000)
            scanner.fail("elements with " + std::to_string(n_tags) + " tags.");
          for (std::int32_t k = 0; k < n_block; ++k, ++i)
            {
              scanner.binary<std::int32_t>("an element's number");
              read_element_2(content, true, type, n_tags);
            }
        }
      scanner.set_binary(false);
    }



    /** What $MeshFormat says. */
    struct Format
    {
      bool version_4 = false;
      bool binary    = false;
    };



    Format
    read_format(FileScanner &scanner)
    {
      Format format;
      scanner.expect("$MeshFormat");
      const std::string version(scanner.word("the version"));
      format.version_4 = version == "4.1";
      if (!format.version_4 && version != "2" && version != "2.0" && version != "2.1"
          && version != "2.2")
        scanner.fail("the version of the format is " + excerpt(version)
                     + "; 2.2 and 4.1 can be read. Save the mesh in one of these (gmsh -format "
                       "msh41).");
      format.binary = scanner.integer("the file type", 0, 1) == 1;
      if (scanner.integer("the data size") != 8)
        scanner.fail("the data size must be 8 bytes.");
      scanner.line();
      if (format.binary)
        {
          scanner.set_binary(true);
          const auto one = scanner.binary<std::int32_t>("the number one");
          if (one != 1 && one != 0x01000000)
            scanner.fail("the number one, which tells the order of bytes, reads as "
                         + std::to_string(one) + ".");
          scanner.set_swap(one != 1);
          scanner.set_binary(false);
        }
      scanner.expect("$EndMeshFormat");
      return format;
    }
  } // namespace



  mesh::TetMesh
  read_msh(const std::string &file)
  {
    FileScanner  scanner(file);
    MeshBuilder  builder([&](const std::string &message) { scanner.fail(message); });
    MshContent   content(scanner, builder);
    const Format format = read_format(scanner);
    Msh4Sections sections(content, format.binary);
    bool         has_nodes = false, has_elements = false;

    while (!scanner.at_end())
      {
        const std::string section(scanner.word("a section"));
        if (section.size() < 2 || section[0] != '$')
          scanner.fail(excerpt(section) + " stands where a section ($...) should begin.");
        if (section == "$PartitionedEntities")
          scanner.fail("the mesh is partitioned. Save it in one part (gmsh -part 0).");
        if (section == "$Elements" && !has_nodes)
          scanner.fail("$Elements comes before $Nodes.");
        if ((section == "$Nodes" && has_nodes) || (section == "$Elements" && has_elements))
          scanner.fail("there is a second section " + section + ".");

        if (section == "$PhysicalNames")
          read_physical_names(scanner, builder);
        else if (section == "$Entities" && format.version_4)
          sections.read_entities();
        else if (section == "$Nodes")
          {
            format.version_4 ? sections.read_nodes() : read_nodes_2(content, format.binary);
            has_nodes = true;
          }
        else if (section == "$Elements")
          {
            format.version_4 ? sections.read_elements() : read_elements_2(content, format.binary);
            has_elements = true;
          }
        else
          {
            scanner.skip_past("$End" + section.substr(1));
            continue;
          }
        scanner.expect("$End" + section.substr(1));
      }
    if (!has_nodes || !has_elements)
      scanner.fail(std::string("the file ends without ") + (has_nodes ? "$Elements." : "$Nodes."));
    return builder.take();
  }
} // namespace tetradapt::io
