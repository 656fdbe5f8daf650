// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/mesh_broadcast.h"

#include "tetradapt/core/on_first_rank.h"

#include <sstream>

namespace tetradapt::mesh
{
  namespace
  {
    /** Names, ids, selections and how many ends kept places have as text; each string on a line of
     * its own. */
    std::string
    names_to_text(const TetMesh &mesh)
    {
      std::ostringstream text;
      text << mesh.patches.size() << '\n';
      for (const Patch &patch : mesh.patches)
        {
          text << patch.boundary_id << ' ' << patch.selections.size() << '\n' << patch.name << '\n';
          for (const auto &selection : patch.selections)
            text << selection << '\n';
        }
      text << mesh.region_names.size() << '\n';
      for (const auto &region : mesh.region_names)
        text << region.first << '\n' << region.second << '\n';
      text << mesh.kept.size() << '\n';
      for (const KeptPlace &place : mesh.kept)
        text << place.ends.size() << '\n' << place.name << '\n';
      return text.str();
    }

    void
    names_from_text(const std::string &content, TetMesh &mesh)
    {
      std::istringstream text(content);
      std::string        line;
      const auto         next_line = [&]() {
        std::getline(text, line);
        return line;
      };
      mesh.patches.resize(std::stoul(next_line()));
      for (Patch &patch : mesh.patches)
        {
          std::istringstream numbers(next_line());
          std::size_t        n_selections = 0;
          numbers >> patch.boundary_id >> n_selections;
          patch.name = next_line();
          patch.selections.clear();
          for (std::size_t i = 0; i < n_selections; ++i)
            patch.selections.push_back(next_line());
        }
      mesh.region_names.clear();
      const std::size_t n_regions = std::stoul(next_line());
      for (std::size_t i = 0; i < n_regions; ++i)
        {
          const int id          = std::stoi(next_line());
          mesh.region_names[id] = next_line();
        }
      mesh.kept.resize(std::stoul(next_line()));
      for (KeptPlace &place : mesh.kept)
        {
          place.ends.resize(std::stoul(next_line()));
          place.name = next_line();
        }
    }
  } // namespace

  void
  broadcast(TetMesh &mesh, MPI_Comm communicator)
  {
    if (core::is_alone(communicator))
      return;
    core::broadcast(mesh.points, communicator);
    core::broadcast(mesh.cells, communicator);
    core::broadcast(mesh.regions, communicator);
    core::broadcast(mesh.faces, communicator);
    std::vector<Point<3>> kept_points;
    for (const KeptPlace &place : mesh.kept)
      kept_points.insert(kept_points.end(), place.ends.begin(), place.ends.end());
    core::broadcast(kept_points, communicator);
    const std::string names = names_to_text(mesh);
    std::vector<char> text(names.begin(), names.end());
    core::broadcast(text, communicator);
    names_from_text(std::string(text.begin(), text.end()), mesh);
    auto next = kept_points.begin();
    for (KeptPlace &place : mesh.kept)
      for (Point<3> &end : place.ends)
        end = *next++;
  }

  std::shared_ptr<const TetMesh>
  make_on_first_rank(MPI_Comm communicator, const std::function<TetMesh()> &make)
  {
    auto mesh = std::make_shared<TetMesh>();
    core::on_first_rank(communicator, [&]() { *mesh = make(); });
    broadcast(*mesh, communicator);
    return mesh;
  }
} // namespace tetradapt::mesh
