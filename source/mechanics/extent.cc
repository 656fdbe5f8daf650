// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/extent.h"

#include <algorithm>

namespace tetradapt::mechanics
{
  PatchExtents::PatchExtents(const mesh::TetMesh &mesh) : mesh(mesh), patches(mesh.patches.size())
  {
    for (const mesh::BoundaryFace &face : mesh.faces)
      {
        ++patches[face.patch].n_faces;
        patches[face.patch].area += mesh::face_area_vector(mesh, face).norm();
      }
  }

  Extent
  PatchExtents::of(const std::string &selection) const
  {
    Extent sum;
    for (unsigned int p = 0; p < patches.size(); ++p)
      {
        const auto &selections = mesh.patches[p].selections;
        if (std::find(selections.begin(), selections.end(), selection) == selections.end())
          continue;
        sum.n_faces += patches[p].n_faces;
        sum.area += patches[p].area;
      }
    return sum;
  }

  bool
  acts_on_body(const scene::LoadType type)
  {
    return type == scene::LoadType::body_force || type == scene::LoadType::gravity
           || type == scene::LoadType::rotation || type == scene::LoadType::temperature;
  }

  Extent
  body_extent(const scene::LoadParameters      &load,
              const mesh::TetMesh              &mesh,
              const std::vector<RegionFigures> &regions)
  {
    const auto ids
      = resolve_regions(load.selector.ids, load.selector.groups, mesh, "Loads/" + load.name);
    Extent sum;
    for (const RegionFigures &region : regions)
      if (ids.count(region.region) != 0)
        {
          sum.n_cells += region.n_cells;
          sum.volume += region.volume;
        }
    return sum;
  }
} // namespace tetradapt::mechanics
