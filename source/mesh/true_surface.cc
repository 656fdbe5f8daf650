// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/true_surface.h"

#include "curved_surface.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::mesh
{
  namespace
  {
    /** Cosine of the largest angle between a face's normal and the surface's. */
    constexpr double aligned = 0.5;

    double
    longest_edge(const TetMesh &mesh, const BoundaryFace &face)
    {
      double longest = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        longest = std::max(
          longest, mesh.points[face.vertices[i]].distance(mesh.points[face.vertices[(i + 1) % 3]]));
      return longest;
    }
  } // namespace

  TrueSurface::TrueSurface(const scene::MeshParameters &parameters, const TetMesh &mesh)
    : mesh(mesh), surfaces(curved_surfaces(parameters)), of_patch(mesh.patches.size(), nullptr)
  {
    for (unsigned int p = 0; p < mesh.patches.size(); ++p)
      for (const auto &surface : surfaces)
        if (const auto &names = mesh.patches[p].selections;
            std::find(names.begin(), names.end(), surface->name()) != names.end())
          of_patch[p] = surface.get();
  }

  TrueSurface::~TrueSurface() = default;

  bool
  TrueSurface::is_projected(const unsigned int face) const
  {
    return of_patch[mesh.faces[face].patch] != nullptr;
  }

  SurfacePoint
  TrueSurface::at(const unsigned int face, const Point<3> &point) const
  {
    const BoundaryFace &boundary_face = mesh.faces[face];
    const Tensor<1, 3>  area          = face_area_vector(mesh, boundary_face);
    const SurfacePoint  flat{point, area / area.norm()};
    const auto         *surface = of_patch[boundary_face.patch];
    if (surface == nullptr)
      return flat;
    auto foot = surface->foot(point, longest_edge(mesh, boundary_face));
    if (!foot)
      return flat;
    const double cosine = foot->normal * flat.normal;
    if (!(std::abs(cosine) >= aligned))
      return flat;
    if (cosine < 0.)
      foot->normal *= -1.;
    return *foot;
  }
} // namespace tetradapt::mesh
