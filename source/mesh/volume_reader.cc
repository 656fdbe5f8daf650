// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/volume_reader.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/embedding.h"
#include "tetradapt/mesh/file_scanner.h"
#include "tetradapt/mesh/mesh_checks.h"
#include "tetradapt/mesh/msh_reader.h"
#include "tetradapt/mesh/node_ele_reader.h"
#include "tetradapt/mesh/vtk_reader.h"
#include "tetradapt/mesh/vtu_reader.h"

#include <filesystem>

namespace tetradapt::mesh
{
  TetMesh
  read_volume_mesh(const std::string &file, const core::Log &log)
  {
    const std::string ending = lower_case(std::filesystem::path(file).extension().string());
    TetMesh           mesh;
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
    finalize(mesh, "'" + file + "'");
    check_embedding(mesh, "'" + file + "'", log);
    return mesh;
  }
} // namespace tetradapt::mesh
