// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/volume_reader.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/io/file_scanner.h"
#include "tetradapt/io/msh_reader.h"
#include "tetradapt/io/node_ele_reader.h"
#include "tetradapt/io/vtk_reader.h"
#include "tetradapt/io/vtu_reader.h"
#include "tetradapt/mesh/embedding.h"
#include "tetradapt/mesh/finalize.h"

#include <filesystem>

namespace tetradapt::io
{
  mesh::TetMesh
  read_volume_mesh(const std::string &file, const core::Log &log)
  {
    const std::string ending = lower_case(std::filesystem::path(file).extension().string());
    mesh::TetMesh     mesh;
    if (ending == ".msh")
      mesh = read_msh(file);
    else if (ending == ".vtk")
      mesh = read_vtk(file);
    else if (ending == ".vtu")
      mesh = read_vtu(file);
    else if (ending == ".node" || ending == ".ele" || ending == ".face")
      mesh = read_node_ele(file);
    else
      throw core::InputError(
        "The volume mesh '" + file + "' has "
        + (ending.empty() ? "no ending" : "the unknown ending '" + ending + "'")
        + "; .msh, .vtk, .vtu, .node, .ele and .face can be read.");
    mesh::finalize(mesh, "'" + file + "'");
    mesh::check_embedding(mesh, "'" + file + "'", log);
    return mesh;
  }
} // namespace tetradapt::io
