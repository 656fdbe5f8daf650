// SPDX-License-Identifier: AGPL-3.0-or-later
// Every volume format holds the same two tetrahedra with two regions and one named
// boundary; then files that are damaged, each with its message.

#include "tetradapt/core/exceptions.h"
#include "tetradapt/io/volume_reader.h"
#include "tetradapt/mesh/mesh_totals.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

using namespace tetradapt;
using namespace tetradapt::io;
using namespace tetradapt::mesh;

void
write(const std::string &file, const std::string &content)
{
  std::ofstream(file, std::ios::binary) << content;
}

void
read(const std::string &file)
{
  try
    {
      const TetMesh    mesh   = read_volume_mesh(file);
      const MeshTotals totals = mesh_totals(mesh);
      std::cout << file << ": " << totals.n_points << " points, volume " << totals.volume;
      for (const auto &[id, region] : totals.regions)
        std::cout << ", region " << id << " (" << region.name << ") " << region.volume;
      for (const auto &entry : totals.patches)
        std::cout << ", " << describe(entry.patch) << " " << entry.area;
      std::cout << std::endl;
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

void
read(const std::string &file, const std::string &content)
{
  write(file, content);
  read(file);
}

/** Replaces the first @p from by @p to. */
std::string
edit(std::string text, const std::string &from, const std::string &to)
{
  const auto place = text.find(from);
  if (place == std::string::npos)
    std::cout << "NOT FOUND: " << from << std::endl;
  else
    text.replace(place, from.size(), to);
  return text;
}

/** Numbers as bytes, the highest first if @p big. */
template <typename T>
std::string
bytes(const std::vector<T> &values, const bool big = false)
{
  std::string result;
  for (const T &value : values)
    {
      std::string part(sizeof(T), '\0');
      std::memcpy(&part[0], &value, sizeof(T));
      if (big)
        std::reverse(part.begin(), part.end());
      result += part;
    }
  return result;
}

// The corner (0,0,0) (1,0,0) (0,1,0) (0,0,1) of volume 1/6 is region 10, the
// other tetrahedron on its face x+y+z=1, with the tip (1,1,1), of volume 1/3, region
// 20. The triangle in z=0 of area 1/2 has the boundary id 7. The second tetrahedron
// is written the wrong way round.
const std::string msh_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 7 "floor plate"
3 10 "soft"
3 20 "hard"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 0 1 0
14 0 0 1
25000 1 1 1
6 9 9 9
$EndNodes
$Elements
4
1 15 2 0 1 6
2 2 2 7 1 1 2 3
3 4 2 10 1 1 2 3 14
4 4 2 20 2 2 3 25000 14
$EndElements
)";

const std::string msh_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
2 7 "floor plate"
3 10 "soft"
3 20 "hard"
$EndPhysicalNames
$Entities
1 0 1 2
1 0 0 0 0
1 0 0 0 1 1 0 1 -7 0
1 0 0 0 1 1 1 1 10 1 1
2 0 0 0 1 1 1 1 20 0
$EndEntities
$Nodes
2 5 1 25000
0 1 0 1
1
0 0 0
3 1 1 4
2
3
14
25000
1 0 0 .5 .5 .5
0 1 0 .5 .5 .5
0 0 1 .5 .5 .5
1 1 1 .5 .5 .5
$EndNodes
$Elements
3 3 1 3
2 1 2 1
1 1 2 3
3 1 4 1
2 1 2 3 14
3 2 4 1
3 2 3 25000 14
$EndElements
)";

std::string
msh_2_binary()
{
  const std::vector<int> one{1};
  std::string            text = "$MeshFormat\n2.2 1 8\n" + bytes(one)
                     + "\n$EndMeshFormat\n$PhysicalNames\n3\n2 7 \"floor plate\"\n3 10 \"soft\"\n"
                       "3 20 \"hard\"\n$EndPhysicalNames\n$Nodes\n5\n";
  const double points[5][3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  for (int i = 0; i < 5; ++i)
    text += bytes<int>({i + 1}) + bytes<double>({points[i][0], points[i][1], points[i][2]});
  text += "\n$EndNodes\n$Elements\n3\n";
  text += bytes<int>({2, 1, 2, 1, 7, 1, 1, 2, 3});
  text += bytes<int>({4, 2, 2, 2, 10, 1, 1, 2, 3, 4, 3, 20, 2, 2, 3, 5, 4});
  return text + "\n$EndElements\n";
}

std::string
msh_4_binary()
{
  using Size       = std::uint64_t;
  std::string text = "$MeshFormat\n4.1 1 8\n" + bytes<int>({1}) + "\n$EndMeshFormat\n$Entities\n"
                     + bytes<Size>({0, 0, 1, 2});
  const std::vector<double> box{0, 0, 0, 1, 1, 1};
  for (const int physical : {7, 10, 20})
    text += bytes<int>({physical == 20 ? 2 : 1}) + bytes(box) + bytes<Size>({1})
            + bytes<int>({physical}) + bytes<Size>({0});
  text += "\n$EndEntities\n$Nodes\n" + bytes<Size>({1, 5, 1, 5}) + bytes<int>({3, 1, 0})
          + bytes<Size>({5, 1, 2, 3, 4, 5})
          + bytes<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  text += "\n$EndNodes\n$Elements\n" + bytes<Size>({3, 3, 1, 3}) + bytes<int>({2, 1, 2})
          + bytes<Size>({1, 1, 1, 2, 3}) + bytes<int>({3, 1, 4}) + bytes<Size>({1, 2, 1, 2, 3, 4})
          + bytes<int>({3, 2, 4}) + bytes<Size>({1, 3, 2, 3, 5, 4});
  return text + "\n$EndElements\n";
}

const std::string vtk_head  = "# vtk DataFile Version 3.0\na title\n";
const std::string vtk_ascii = vtk_head + R"(ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0 1 0 0 0 1 0
0 0 1 1 1 1
METADATA
INFORMATION 0

CELLS 4 17
3 0 1 2
4 0 1 2 3
4 1 2 4 3
2 0 1
CELL_TYPES 4
5 10 10 3
CELL_DATA 4
SCALARS quality double 1
LOOKUP_TABLE default
1 2 3 4
FIELD FieldData 2
MaterialIDs 1 4 int
7 10 20 0
velocity 3 4 float
0 0 0 0 0 0 0 0 0 0 0 0
POINT_DATA 5
VECTORS u float
0 0 0 0 0 0 0 0 0 0 0 0 0 0 0
)";

std::string
vtk_binary(const bool version_5)
{
  using Size       = std::int64_t;
  std::string text = version_5 ? "# vtk DataFile Version 5.1\na title\n" : vtk_head;
  text += "BINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n"
          + bytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, true);
  if (version_5)
    text += "\nCELLS 4 11\nOFFSETS vtktypeint64\n" + bytes<Size>({0, 3, 7, 11}, true)
            + "\nCONNECTIVITY vtktypeint64\n"
            + bytes<Size>({0, 1, 2, 0, 1, 2, 3, 1, 2, 4, 3}, true);
  else
    text += "\nCELLS 3 14\n" + bytes<int>({3, 0, 1, 2, 4, 0, 1, 2, 3, 4, 1, 2, 4, 3}, true);
  return text + "\nCELL_TYPES 3\n" + bytes<int>({5, 10, 10}, true)
         + "\nCELL_DATA 3\nSCALARS region short\nLOOKUP_TABLE default\n"
         + bytes<short>({0, 10, 20}, true) + "\nSCALARS boundary_id int\nLOOKUP_TABLE default\n"
         + bytes<int>({7, 0, 0}, true) + "\n";
}

const std::string node = "# points\n5 3 1 0\n\n1 0 0 0 .5\n2 1 0 0 .5 # the second\n3 0 1 0 .5\n"
                         "4 0 0 1 .5\n5 1 1 1 .5\n";
const std::string ele  = "2 4 1\n1 1 2 3 4 10\n2 2 3 5 4 20\n";
const std::string face = "1 1\n1 1 2 3 7\n";

/** The corner with nodes in the middle of its edges, in TetGen's order. */
const std::string node_quadratic = "10 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 0 .5 .5\n"
                                   "5 0 0 .5\n6 .5 0 0\n7 .5 .5 0\n8 .5 0 .5\n9 0 .5 0\n";
const std::string ele_quadratic  = "1 10 0\n0 0 1 2 3 4 5 6 7 8 9\n";

void
test_good_files()
{
  read("a.msh", msh_2);
  read("b.msh", msh_4);
  read("c.msh", msh_2_binary());
  read("d.MSH", msh_4_binary());
  read("a.vtk", vtk_ascii);
  read("b.vtk", vtk_binary(false));
  read("c.vtk", vtk_binary(true));
  write("a.node", node);
  write("a.ele", ele);
  read("a.ele");
  read("a.face", face);
  read("a.node");
  write("q.ele", ele_quadratic);
  read("q.node", node_quadratic);
  std::string crlf = msh_2;
  for (std::size_t i = 0; (i = crlf.find('\n', i)) != std::string::npos; i += 2)
    crlf.insert(i, "\r");
  read("e.msh", crlf);
}

void
test_bad_msh()
{
  const std::string m2 = "bad.msh", b2 = msh_2_binary(), b4 = msh_4_binary();
  read(m2, edit(msh_2, "2.2 0 8", "1.0 0 8"));
  read(m2, edit(msh_2, "2.2 0 8", "2.2 0 4"));
  read(m2, edit(msh_2, "$MeshFormat", "solid"));
  read(m2, edit(msh_2, "$Nodes\n6", "$Nodes\n600000000000"));
  read(m2, edit(msh_2, "$Nodes\n6", "$Nodes\n7"));
  read(m2, edit(msh_2, "14 0 0 1", "2 0 0 1"));
  read(m2, edit(msh_2, "14 0 0 1", "-4 0 0 1"));
  read(m2, edit(msh_2, "14 0 0 1", "14 0 0 1e999"));
  read(m2, edit(msh_2, "14 0 0 1", "14 0 nan 1"));
  read(m2, edit(msh_2, "14 0 0 1", "14 0 0.1.2 1"));
  read(m2, edit(msh_2, "25000 14\n", "25001 14\n"));
  read(m2, edit(msh_2, "4 4 2 20", "4 5 2 20"));
  read(m2, edit(msh_2, "$EndElements\n", ""));
  read(m2, edit(msh_2, "\"soft\"", "soft"));
  read(m2, edit(msh_2, "2 2 2 7 1 1 2 3", "2 2 2 7 1 1 2 25000"));
  read(m2, msh_2.substr(0, msh_2.find("$Elements")));
  read(m2, edit(msh_4, "1 1 1 1 20 0", "1 1 1 2 20 21 0"));
  read(m2, edit(msh_4, "2 5 1 25000", "2 6 1 25000"));
  read(m2, edit(msh_4, "$Entities", "$PartitionedEntities"));
  read(m2, b2.substr(0, b2.size() / 2));
  read(m2, b4.substr(0, b4.size() - 40));
  read(m2, edit(b2, bytes<int>({1}), bytes<int>({77})));
  read(m2, "");
  read("nowhere.msh");
  read("mesh.stl", "solid");
  read("mesh", "solid");
}

void
test_bad_vtk()
{
  read("bad.vtk", edit(vtk_ascii, "# vtk", "vtk"));
  read("bad.vtk", edit(vtk_ascii, "UNSTRUCTURED_GRID", "POLYDATA"));
  read("bad.vtk", edit(vtk_ascii, "POINTS 5", "POINTS 5000000"));
  read("bad.vtk", edit(vtk_ascii, "CELLS 4 17", "CELLS 5 17"));
  read("bad.vtk", edit(vtk_ascii, "4 1 2 4 3", "4 1 2 5 3"));
  read("bad.vtk", edit(vtk_ascii, "4 1 2 4 3", "9 1 2 4 3"));
  read("bad.vtk", edit(vtk_ascii, "5 10 10 3", "5 10 12 3"));
  read("bad.vtk", edit(vtk_ascii, "5 10 10 3", "5 10 10 10"));
  read("bad.vtk", edit(vtk_ascii, "7 10 20 0", "7 10 20.5 0"));
  read("bad.vtk", edit(vtk_ascii, "CELL_DATA 4", "CELL_DATA 3"));
  read("bad.vtk", edit(vtk_ascii, "SCALARS quality double", "SCALARS quality string"));
  read("bad.vtk", vtk_ascii.substr(0, vtk_ascii.find("CELL_TYPES")));
  read("bad.vtk", vtk_binary(false).substr(0, 120));
  read("bad.vtk", vtk_binary(true).substr(0, 250));
}

void
test_bad_node_ele()
{
  const auto with = [](const std::string &n, const std::string &e, const std::string &f) {
    write("bad.node", n);
    write("bad.face", f);
    read("bad.ele", e);
  };
  with(edit(node, "5 3 1 0", "5 2 1 0"), ele, face);
  with(edit(node, "5 3 1 0", "6 3 1 0"), ele, face);
  with(edit(node, "3 0 1 0", "4 0 1 0"), ele, face);
  with(edit(node, "1 1 1 .5", "1 1"), ele, face);
  with(node, edit(ele, "2 3 5 4 20", "2 3 6 4 20"), face);
  with(node, edit(ele, "2 3 5 4 20", "0 3 5 4 20"), face);
  with(node, edit(ele, "10", "10.5"), face);
  with(node, edit(ele, "2 4 1", "2 5 1"), face);
  with(node, edit(ele, "2 4 1", "0 4 1"), face);
  with(node, ele, edit(face, "1 2 3 7", "1 2 5 7"));
  with(edit(node_quadratic, "4 0 .5 .5", "4 0 .5 .6"), ele_quadratic, "0 0\n");
  std::filesystem::remove("bad.ele");
  read("bad.node");
}

int
main()
{
  std::filesystem::create_directory("volume_readers_scratch");
  std::filesystem::current_path("volume_readers_scratch");
  test_good_files();
  test_bad_msh();
  test_bad_vtk();
  test_bad_node_ele();
  std::filesystem::current_path("..");
  std::filesystem::remove_all("volume_readers_scratch");
}
