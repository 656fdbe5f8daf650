// SPDX-License-Identifier: AGPL-3.0-or-later
// A .vtu file gives back every bit of mesh and displacement; all encodings that VTK
// has are read; damaged files say what is wrong.

#include "tetradapt/core/exceptions.h"
#include "tetradapt/io/scalar_types.h"
#include "tetradapt/io/volume_reader.h"
#include "tetradapt/io/vtu_reader.h"
#include "tetradapt/io/vtu_writer.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/mesh_totals.h"

#include <sys/resource.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

using namespace tetradapt;
using namespace tetradapt::io;
using namespace tetradapt::mesh;

std::string
content_of(const std::string &file)
{
  std::ifstream      in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void
write(const std::string &file, const std::string &content)
{
  std::ofstream(file, std::ios::binary) << content;
}

template <typename Container>
bool
same_bits(const Container &a, const Container &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

void
test_round_trip(const unsigned int degree)
{
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  auto mesh = std::make_shared<TetMesh>(bricks({0., 0., 0.}, {1., 2., 1.}, {{3, 4, 2}}));
  for (auto &point : mesh->points)
    for (unsigned int d = 0; d < 3; ++d)
      point[d] += 0.02 * uniform(random);
  for (unsigned int c = 0; c < mesh->n_cells(); ++c)
    mesh->regions[c] = (c % 3) - 1;
  mesh->region_names = {{-1, "outside <&> \"in\""}, {1, "b c"}};

  NodalField field(mesh, degree);
  for (auto &u : field.values)
    for (unsigned int d = 0; d < 3; ++d)
      u[d] = uniform(random) * std::pow(10., 300. * uniform(random));
  field.values[0][0] = -0.;
  field.values[0][1] = 5e-324;

  VtuWriter writer(field);
  writer.add_regions();
  writer.add_boundary();
  writer.add_value("energy", 1. / 3.);
  writer.add_text("made by", "tetradapt <test>");
  writer.add_cell_data("eta", 1, std::vector<double>(mesh->n_cells(), 0.1));
  writer.add_point_data("stress", 6, std::vector<double>(6 * writer.n_points(), 2.));
  writer.add_point_ids("number", std::vector<int>(writer.n_points(), 4));
  writer.write("round_trip.vtu");

  DisplacementFile  back = read_displacement_vtu("round_trip.vtu");
  const NodalField &copy = *back.displacement;
  std::cout << "degree " << copy.degree() << ": points "
            << same_bits(copy.mesh().points, mesh->points) << ", cells "
            << (copy.mesh().cells == mesh->cells) << ", regions "
            << (copy.mesh().regions == mesh->regions
                && copy.mesh().region_names == mesh->region_names)
            << ", displacement " << same_bits(copy.values, field.values) << ", boundary "
            << compare_totals(mesh_totals(*mesh), mesh_totals(copy.mesh()), 0.).size() << ' '
            << copy.mesh().patches[3].name << ", energy " << (back.values.at("energy") == 1. / 3.)
            << ", text " << back.texts.at("made by") << std::endl;
  const TetMesh again = read_volume_mesh("round_trip.vtu");
  std::cout << "as a mesh: " << (again.cells == mesh->cells) << ' '
            << compare_totals(mesh_totals(*mesh), mesh_totals(again), 0.).size() << std::endl;

  try
    {
      writer.add_cell_data("eta", 3, std::vector<double>(5));
      std::cout << "NOT REFUSED" << std::endl;
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

std::string
base64(const std::string &bytes)
{
  const char *letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3)
    {
      unsigned int bits = 0;
      for (std::size_t k = 0; k < 3; ++k)
        bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
      for (std::size_t k = 0; k < 4; ++k)
        text += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63];
    }
  return text;
}

/** How a file is written. */
struct Variant
{
  std::string format; // ascii, binary, raw, base64
  bool        compressed, long_header, big;
};

template <typename T>
std::string
bytes(const std::vector<T> &values, const bool big)
{
  std::string result;
  for (const T &value : values)
    {
      std::string part(sizeof(T), '\0');
      std::memcpy(&part[0], &value, sizeof(T));
      if (big == is_little_endian())
        std::reverse(part.begin(), part.end());
      result += part;
    }
  return result;
}

/** Header and data of an array, in blocks of 40 bytes if they are compressed. */
std::string
encoded(const std::string &data, const Variant &v)
{
  const auto number = [&](const std::uint64_t n) {
    return v.long_header ? bytes<std::uint64_t>({n}, v.big)
                         : bytes<std::uint32_t>({static_cast<std::uint32_t>(n)}, v.big);
  };
  const bool text = v.format == "binary" || v.format == "base64";
  if (!v.compressed)
    return text ? base64(number(data.size()) + data) : number(data.size()) + data;
  std::string header = number((data.size() + 39) / 40) + number(40) + number(data.size() % 40),
              body;
  for (std::size_t i = 0; i < data.size(); i += 40)
    {
      const std::string part = data.substr(i, 40);
      std::string       zip(100, '\0');
      uLongf            size = zip.size();
      ::compress(reinterpret_cast<Bytef *>(&zip[0]),
                 &size,
                 reinterpret_cast<const Bytef *>(part.data()),
                 part.size());
      header += number(size);
      body += zip.substr(0, size);
    }
  return text ? base64(header) + base64(body) : header + body;
}

/** Two tetrahedra, regions 10 and 20, and a triangle with boundary id 7. */
std::string
file_content(const Variant &v)
{
  std::string appended;
  const auto  array = [&](const std::string &name, const std::string &type, const auto &values) {
    std::string text = "<DataArray type=\"" + type + "\" Name=\"" + name + "\""
                       + (name == "p" ? " NumberOfComponents=\"3\"" : "");
    if (v.format == "ascii")
      {
        text += " format=\"ascii\">\n";
        for (const auto value : values)
          text += std::to_string(value) + " ";
        return text + "\n</DataArray>\n";
      }
    const std::string data = encoded(bytes(values, v.big), v);
    if (v.format == "binary")
      return text + " format=\"binary\">\n  " + data + "\n</DataArray>\n";
    text += " format=\"appended\" offset=\"" + std::to_string(appended.size()) + "\"/>\n";
    appended += data;
    return text;
  };
  std::string text = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
                                 "version=\"1.0\" byte_order=\"")
                     + (v.big ? "Big" : "Little") + "Endian\" header_type=\"UInt"
                     + (v.long_header ? "64" : "32") + "\""
                     + (v.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "")
                     + ">\n<UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n";
  // One statement an array: each adds to the appended data.
  text += "<CellData>\n";
  text += array("region", "Int16", std::vector<short>{0, 10, 20});
  text += array("boundary_id", "UInt8", std::vector<unsigned char>{7, 0, 0});
  text += "</CellData>\n<Points>";
  text += array("p", "Float32", std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  text += "</Points>\n<Cells>";
  text
    += array("connectivity", "Int64", std::vector<std::int64_t>{0, 1, 2, 0, 1, 2, 3, 1, 2, 4, 3});
  text += array("offsets", "UInt32", std::vector<unsigned int>{3, 7, 11});
  text += array("types", "UInt8", std::vector<unsigned char>{5, 10, 10});
  text += "</Cells>\n</Piece></UnstructuredGrid>\n";
  if (!appended.empty())
    text += "<AppendedData encoding=\"" + v.format + "\">\n_" + appended + "\n</AppendedData>\n";
  return text + "</VTKFile>\n";
}

void
read(const std::string &content)
{
  write("bad.vtu", content);
  try
    {
      const MeshTotals totals = mesh_totals(read_volume_mesh("bad.vtu"));
      std::cout << "volume " << totals.volume << ", regions " << totals.regions.at(10).volume << ' '
                << totals.regions.at(20).volume << ", area " << totals.patches[0].area << std::endl;
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

void
test_variants()
{
  unsigned int n = 0, n_right = 0;
  for (const char *format : {"ascii", "binary", "raw", "base64"})
    for (const bool compressed : {false, true})
      for (const bool long_header : {false, true})
        for (const bool big : {false, true})
          {
            write("variant.vtu", file_content({format, compressed, long_header, big}));
            const TetMesh    mesh   = read_volume_mesh("variant.vtu");
            const MeshTotals totals = mesh_totals(mesh);
            ++n;
            n_right += std::abs(totals.regions.at(10).volume - 1. / 6.) < 1e-15
                       && std::abs(totals.regions.at(20).volume - 1. / 3.) < 1e-15
                       && mesh.patches[0].boundary_id == 7
                       && std::abs(totals.patches[0].area - 0.5) < 1e-15;
          }
  std::cout << n_right << " of " << n << " variants are read" << std::endl;
}

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

/** Few bytes that stand for 300 MB. */
void
test_bombs()
{
  const Variant     v{"binary", true, true, false};
  const std::string content = file_content(v);
  const std::string zeros(1 << 20, '\0');
  std::string       zip(2000, '\0');
  uLongf            size = zip.size();
  ::compress(reinterpret_cast<Bytef *>(&zip[0]),
             &size,
             reinterpret_cast<const Bytef *>(zeros.data()),
             zeros.size());
  std::vector<std::uint64_t> header{300, zeros.size(), 0};
  header.insert(header.end(), 300, size);
  std::string blocks;
  for (unsigned int i = 0; i < 300; ++i)
    blocks += zip.substr(0, size);
  const std::string bomb = base64(bytes(header, v.big)) + base64(blocks);

  const auto points = bytes(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, v.big);
  const auto connectivity
    = bytes(std::vector<std::int64_t>{0, 1, 2, 0, 1, 2, 3, 1, 2, 4, 3}, v.big);
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  read(edit(content, encoded(points, v), bomb));
  read(edit(content, encoded(connectivity, v), bomb));
  read(edit(content,
            "</Piece>",
            "</Piece><FieldData><Array type=\"String\" Name=\"region_names\" "
            "NumberOfTuples=\"1\" format=\"binary\">"
              + bomb + "</Array></FieldData>"));
  read(edit(content,
            "</Piece>",
            "</Piece><FieldData><DataArray type=\"Int64\" Name=\"boundary_faces\" "
            "NumberOfComponents=\"3\" NumberOfTuples=\"2\" format=\"binary\">"
              + bomb
              + "</DataArray><DataArray type=\"Int64\" Name=\"boundary_ids\" "
                "NumberOfTuples=\"2\">7 8</DataArray></FieldData>"));
  // Blocks that share their bytes: each fits into the file, all of them do not.
  const std::uint64_t many = 1000, whole = 1000 * size;
  header.assign({many, 1u << 20, 0});
  header.insert(header.end(), many, whole);
  read(edit(content, encoded(points, v), base64(bytes(header, v.big)) + base64(blocks)));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::cout << "memory stays small: " << (usage.ru_maxrss - before.ru_maxrss < 100000) << std::endl;
}

void
test_bad_files()
{
  const std::string ascii  = file_content({"ascii", false, false, false});
  const std::string binary = file_content({"binary", false, false, false});
  const std::string raw    = file_content({"raw", false, true, false});
  const std::string zipped = file_content({"raw", true, true, false});
  read("This is no XML.");
  read("<VTKFile type=\"PolyData\"/>");
  read("<html/>");
  read(ascii.substr(0, ascii.size() / 2));
  read(edit(ascii, "UInt32", "UInt16"));
  read(edit(zipped, "vtkZLib", "vtkLZ4"));
  read(edit(ascii, "NumberOfCells=\"3\"", "NumberOfCells=\"0\""));
  read(edit(ascii, "NumberOfPoints=\"5\"", "NumberOfPoints=\"4000000000\""));
  read(edit(ascii, "NumberOfPoints=\"5\"", "NumberOfPoints=\"all\""));
  read(edit(ascii, "\"connectivity\"", "\"nodes\""));
  read(edit(ascii, "0 1 2 0 1 2 3", "0 1 2 0 1 2 5"));
  read(edit(ascii, "0 1 2 0 1 2 3", "0 1 x 0 1 2 3"));
  read(edit(ascii, "3 7 11", "3 7 1100"));
  read(edit(ascii, "5 10 10", "5 10 14"));
  read(edit(binary, "format=\"binary\">\n  ", "format=\"binary\">\n  !"));
  read(edit(binary, "format=\"binary\">\n  B", "format=\"binary\">\n  //8/"));
  read(edit(raw, "offset=\"0\"", "offset=\"90000\""));
  read(raw.substr(0, raw.size() - 60));
  read(edit(raw, "Int16", "Complex"));
  std::string broken = zipped; // behind 4 numbers of the first array's header
  broken[zipped.find("\n_") + 2 + 4 * 8 + 3] ^= 0x55;
  read(broken);

  const auto displacement = [](const std::string &content) {
    write("bad.vtu", content);
    try
      {
        read_displacement_vtu("bad.vtu");
        std::cout << "NOT REFUSED" << std::endl;
      }
    catch (const core::InputError &error)
      {
        std::cout << error.what() << std::endl;
      }
  };
  displacement(raw);
  const std::string tets
    = edit(edit(edit(edit(edit(edit(ascii, "0 1 2 0 1 2 3", "0 1 2 3"), "3 7 11", "4 8"),
                          "5 10 10",
                          "10 10"),
                     "NumberOfCells=\"3\"",
                     "NumberOfCells=\"2\""),
                "0 10 20",
                "10 20"),
           "7 0 0",
           "0 0");
  displacement(tets);
  const std::string with = edit(tets,
                                "<CellData>",
                                "<PointData><DataArray type=\"Float64\" Name=\"displacement\" "
                                "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 0 0 0 0 0 0 0 0 0 "
                                "1 2 3</DataArray></PointData>\n<CellData>");
  displacement(edit(with, "1 2 3</", "1 2</"));
  displacement(edit(with, "NumberOfComponents=\"3\"", "NumberOfComponents=\"1\""));
  displacement(edit(with, "1 2 3</", "1 2 inf</"));
  write("good.vtu", with);
  std::cout << read_displacement_vtu("good.vtu").displacement->values[4] << std::endl;

  try
    {
      const TetMesh mesh = bricks({0., 0., 0.}, {1., 1., 1.}, {{1, 1, 1}});
      VtuWriter(mesh).write("no/such/folder.vtu");
      std::cout << "NOT REFUSED" << std::endl;
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

/** A quadratic file numbered by somebody else: nodes in any order, an unused
 * point, a cell turned round, a node of its own for each cell's middle. */
void
test_foreign_quadratic()
{
  const std::string file = R"(<VTKFile type="UnstructuredGrid">
<UnstructuredGrid><Piece NumberOfPoints="12" NumberOfCells="1">
<PointData><DataArray type="Float64" Name="displacement" NumberOfComponents="3" format="ascii">
9 9 9  .5 .5 0  0 0 1  0 0 0  .5 0 .5  0 .5 .5  1 0 0  0 0 .5  0 1 0  .5 0 0  0 .5 0  9 9 9
</DataArray></PointData>
<Points><DataArray type="Float64" Name="x" NumberOfComponents="3" format="ascii">
9 9 9  .5 .5 0  0 0 1  0 0 0  .5 0 .5  0 .5 .5  1 0 0  0 0 .5  0 1 0  .5 0 0  0 .5 0  9 9 9
</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">
3 6 2 8 9 4 7 10 1 5
</DataArray><DataArray type="Int32" Name="offsets" format="ascii">10</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">24</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>
)";
  write("foreign.vtu", file);
  const auto field = read_displacement_vtu("foreign.vtu").displacement;
  double     worst = 0.;
  for (unsigned int n = 0; n < field->n_nodes(); ++n)
    worst = std::max(worst, (field->node_position(n) - (Point<3>() + field->values[n])).norm());
  std::cout << "foreign: " << field->mesh().n_points() << " points, " << field->n_nodes()
            << " nodes, volume positive " << (cell_volume(field->mesh(), 0) > 0.)
            << ", u = x at every node " << (worst == 0.) << std::endl;
}

int
main()
{
  std::filesystem::create_directory("vtu_scratch");
  std::filesystem::current_path("vtu_scratch");
  test_round_trip(1);
  test_round_trip(2);
  test_variants();
  test_bombs();
  test_bad_files();
  test_foreign_quadratic();
  std::filesystem::current_path("..");
  std::filesystem::remove_all("vtu_scratch");
}
