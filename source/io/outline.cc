// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/outline.h"

#include "tetradapt/geometry/checked_surface.h"
#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/io/volume_reader.h"
#include "tetradapt/mesh/blocks.h"
#include "tetradapt/mesh/bricks.h"
#include "tetradapt/mesh/plc.h"

namespace tetradapt::io
{
  using dealii::Tensor;

  namespace
  {
    mesh::TetMesh
    outline_of(const mesh::PiecewiseLinearComplex &plc)
    {
      mesh::TetMesh outline;
      const auto    surface = mesh::triangulate(plc);
      outline.points        = surface.points;
      outline.patches       = plc.patches;
      for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        {
          const auto        &t = surface.triangles[i];
          mesh::BoundaryFace face;
          face.vertices = {{static_cast<unsigned int>(t[0]),
                            static_cast<unsigned int>(t[1]),
                            static_cast<unsigned int>(t[2])}};
          face.patch    = surface.ids[i];
          outline.faces.push_back(face);
        }
      for (const auto &region : plc.regions)
        outline.regions.push_back(region.id);
      if (plc.regions.empty())
        outline.regions.push_back(0);
      return outline;
    }
  } // namespace

  mesh::TetMesh
  outline(const scene::MeshParameters &parameters, const unsigned int number)
  {
    const auto file = [&]() { return parameters.files[parameters.files.size() == 1 ? 0 : number]; };
    switch (parameters.source)
      {
      case scene::MeshSource::box:
        return outline_of(mesh::box_complex(parameters.lower_corner, parameters.upper_corner));
      case scene::MeshSource::blocks:
        return outline_of(
          mesh::blocks_complex(mesh::BlockGrid(parameters.blocks), parameters.block_regions));
      case scene::MeshSource::surface:
        {
          const auto surface = geometry::read_surface(file());
          geometry::check_surface(surface, file());
          return outline_of(mesh::surface_complex(surface, file()));
        }
      case scene::MeshSource::file:
        return read_volume_mesh(file());
      case scene::MeshSource::bricks:
        break;
      }
    mesh::TetMesh body
      = mesh::bricks(parameters.lower_corner, parameters.upper_corner, {{1, 1, 1}});
    body.cells.clear();
    return body;
  }

  std::vector<Point<3>>
  points_on(const mesh::TetMesh &mesh, const mesh::BoundaryFace &face, const unsigned int n_parts)
  {
    const Point<3>       &corner = mesh.points[face.vertices[0]];
    const Tensor<1, 3>    first  = mesh.points[face.vertices[1]] - corner;
    const Tensor<1, 3>    second = mesh.points[face.vertices[2]] - corner;
    std::vector<Point<3>> points;
    for (unsigned int i = 0; i <= n_parts; ++i)
      for (unsigned int j = 0; j <= n_parts - i; ++j)
        // In this form a point of a plane x = const has exactly this x.
        points.push_back(corner + (double(i) * first + double(j) * second) / double(n_parts));
    return points;
  }
} // namespace tetradapt::io
