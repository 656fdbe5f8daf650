// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/boundary_projection.h"

#include "curved_surface.h"
#include "curved_volume.h"
#include "selection_borders.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/checked_surface.h"
#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/mesh/face_selectors.h"
#include "tetradapt/mesh/kept_places.h"
#include "tetradapt/mesh/selection_cuts.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::mesh
{
  namespace
  {
    using Projection = scene::MeshParameters::Projection;

    /** How near a face's corners must be to a surface, by its longest edge. */
    constexpr double near = 1e-2;
    /** Cosine of the largest angle between a face's normal and the surface's. */
    constexpr double aligned = 0.5;
    /** Cosine of the angle up to which two flat faces lie in one plane. */
    constexpr double one_plane = 1. - 1e-10;
    /** A way shorter than this part of an edge is not worth going: repeated
     * projections leave points as they are, bit by bit. */
    constexpr double worth_it = 1e-11;

    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    double
    longest_edge(const TetMesh &mesh, const BoundaryFace &face)
    {
      double longest = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        longest = std::max(
          longest, mesh.points[face.vertices[i]].distance(mesh.points[face.vertices[(i + 1) % 3]]));
      return longest;
    }

    bool
    lies_on(const TetMesh &mesh, const BoundaryFace &face, const CurvedSurface &surface)
    {
      const double length = longest_edge(mesh, face);
      Point<3>     middle;
      for (const unsigned int v : face.vertices)
        {
          const LocalPlane plane = surface.plane_near(mesh.points[v], length);
          if (plane.normal.norm_square() == 0. || std::abs(plane.distance) > near * length)
            return false;
          middle += mesh.points[v] / 3.;
        }
      const Tensor<1, 3> area = face_area_vector(mesh, face);
      return std::abs(surface.plane_near(middle, length).normal * area) >= aligned * area.norm();
    }

    /** Which surface each patch lies on, or none. */
    std::vector<unsigned int>
    surfaces_of_patches(const TetMesh                                     &mesh,
                        const std::vector<std::unique_ptr<CurvedSurface>> &surfaces)
    {
      std::vector<unsigned int> result(mesh.patches.size(), none);
      for (unsigned int p = 0; p < mesh.patches.size(); ++p)
        for (unsigned int s = 0; s < surfaces.size(); ++s)
          if (const auto &names = mesh.patches[p].selections;
              std::find(names.begin(), names.end(), surfaces[s]->name()) != names.end())
            result[p] = s;
      return result;
    }

    /** Per point, how many of its boundary edges are sharp. */
    std::vector<unsigned char>
    count_sharp_edges(const TetMesh &mesh, double angle)
    {
      struct Side
      {
        unsigned int first, second, face;
      };
      std::vector<Side> sides;
      sides.reserve(3 * mesh.faces.size());
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = mesh.faces[f].vertices[i],
                               b = mesh.faces[f].vertices[(i + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), f});
          }
      std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;
      });
      const double               least_cosine = std::cos(angle * dealii::numbers::PI / 180.);
      std::vector<unsigned char> count(mesh.n_points(), 0);
      for (std::size_t i = 0; i + 1 < sides.size(); ++i)
        if (sides[i].first == sides[i + 1].first && sides[i].second == sides[i + 1].second)
          {
            const Tensor<1, 3> a = face_area_vector(mesh, mesh.faces[sides[i].face]);
            const Tensor<1, 3> b = face_area_vector(mesh, mesh.faces[sides[i + 1].face]);
            if (a * b >= least_cosine * a.norm() * b.norm())
              continue;
            for (const unsigned int p : {sides[i].first, sides[i].second})
              count[p] = std::min(count[p] + 1, 3);
          }
      return count;
    }

    /** What a point of the boundary belongs to. */
    struct Place
    {
      std::vector<const CurvedSurface *> surfaces;
      std::vector<const CurvedSurface *> borders;     ///< of selections
      std::vector<Tensor<1, 3>>          planes;      ///< normals of flat faces
      double                             length = 0.; ///< of the longest boundary edge
    };
  } // namespace

  BoundaryProjection::BoundaryProjection(const scene::Scene &scene)
    : feature_angle(scene.mesh.feature_angle),
      borders(std::make_unique<SelectionBorders>(
        borders_are_cut(scene.mesh) ? face_selectors(scene) : decltype(face_selectors(scene))()))
  {
    const scene::MeshParameters &parameters = scene.mesh;
    if (parameters.projection == Projection::surface)
      {
        const bool own     = parameters.projection_file.empty();
        const auto file    = own ? parameters.files.front() : parameters.projection_file;
        const auto surface = geometry::check_surface(geometry::read_surface(file), file);
        every_face         = parameters.source == scene::MeshSource::surface;
        volume             = surface.volume;
        surfaces.push_back(std::make_unique<TriangulatedSurface>(surface.mesh, feature_angle));
      }
    else
      for (unsigned int i = 0; i < parameters.projection_functions.size(); ++i)
        surfaces.push_back(std::make_unique<ZeroSet>(parameters.projection_functions[i], i + 1));
  }

  BoundaryProjection::~BoundaryProjection() = default;

  void
  BoundaryProjection::assign(TetMesh &mesh) const
  {
    const auto of_patch = surfaces_of_patches(mesh, surfaces);
    if (std::any_of(of_patch.begin(), of_patch.end(), [](const auto s) { return s != none; }))
      return;
    // Patch p on surface s becomes entry (p, s) of a table; those that occur are kept.
    const unsigned int        n = surfaces.size() + 1;
    std::vector<unsigned int> number(mesh.patches.size() * n, none);
    std::vector<bool>         is_used(surfaces.size(), false);
    for (BoundaryFace &face : mesh.faces)
      {
        unsigned int s = 0;
        while (s < surfaces.size() && !every_face && !lies_on(mesh, face, *surfaces[s]))
          ++s;
        if (s < surfaces.size())
          is_used[s] = true;
        face.patch         = face.patch * n + s;
        number[face.patch] = 0;
      }
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      if (!is_used[s])
        throw core::InputError(
          surfaces[s]->name()
          + ": no face of the boundary lies on it (its corners within a hundredth of its "
            "longest edge, its normal within 60 degrees). Correct it, or the mesh.");
    std::vector<Patch> patches;
    for (unsigned int entry = 0; entry < number.size(); ++entry)
      if (number[entry] != none)
        {
          number[entry] = patches.size();
          patches.push_back(mesh.patches[entry / n]);
          if (entry % n < surfaces.size())
            patches.back().selections.push_back(surfaces[entry % n]->name());
        }
    for (BoundaryFace &face : mesh.faces)
      face.patch = number[face.patch];
    mesh.patches = std::move(patches);
  }

  bool
  BoundaryProjection::is_projected(const Patch &patch) const
  {
    return surface_of(patch) != nullptr;
  }

  const CurvedSurface *
  BoundaryProjection::surface_of(const Patch &patch) const
  {
    for (const auto &surface : surfaces)
      if (const auto &names = patch.selections;
          std::find(names.begin(), names.end(), surface->name()) != names.end())
        return surface.get();
    return nullptr;
  }

  std::optional<Point<3>>
  BoundaryProjection::foot(const Patch &patch, const Point<3> &point, const double length) const
  {
    const CurvedSurface *surface = surface_of(patch);
    if (surface == nullptr)
      return std::nullopt;
    const auto at = surface->foot(point, length);
    return at ? std::optional<Point<3>>(at->point) : std::nullopt;
  }

  MoveReport
  BoundaryProjection::project(TetMesh &mesh) const
  {
    std::vector<bool> is_kept(mesh.n_points(), false);
    for (const KeptPlace &place : mesh.kept)
      for (const unsigned int v : vertices_of(mesh, place))
        is_kept[v] = true;
    const auto                on_surface = surfaces_of_patches(mesh, surfaces);
    std::vector<unsigned int> place_of_point(mesh.n_points(), none), points;
    std::vector<Place>        places;
    for (const BoundaryFace &face : mesh.faces)
      if (on_surface[face.patch] != none)
        for (const unsigned int v : face.vertices)
          if (place_of_point[v] == none)
            {
              place_of_point[v] = places.size();
              places.emplace_back();
              points.push_back(v);
            }
    for (const BoundaryFace &face : mesh.faces)
      {
        const Tensor<1, 3> area   = face_area_vector(mesh, face);
        const Tensor<1, 3> normal = area / area.norm();
        const double       length = longest_edge(mesh, face);
        for (const unsigned int v : face.vertices)
          if (place_of_point[v] != none)
            {
              Place &place = places[place_of_point[v]];
              place.length = std::max(place.length, length);
              if (on_surface[face.patch] == none)
                {
                  if (std::none_of(place.planes.begin(), place.planes.end(), [&](const auto &n) {
                        return n * normal > one_plane;
                      }))
                    place.planes.push_back(normal);
                  continue;
                }
              const CurvedSurface *surface = surfaces[on_surface[face.patch]].get();
              if (std::find(place.surfaces.begin(), place.surfaces.end(), surface)
                  == place.surfaces.end())
                place.surfaces.push_back(surface);
            }
      }

    const bool                 with_creases = volume > 0.;
    std::vector<unsigned char> n_sharp;
    if (with_creases)
      n_sharp = count_sharp_edges(mesh, feature_angle);
    const auto on_borders = borders->through_points(mesh, feature_angle);
    for (unsigned int i = 0; i < points.size(); ++i)
      if (const auto found = on_borders.find(points[i]); found != on_borders.end())
        places[i].borders = found->second;

    std::vector<PointMove> moves;
    unsigned long          n_lost = 0;
    for (unsigned int i = 0; i < points.size(); ++i)
      {
        const Place            &place = places[i];
        const Point<3>         &here  = mesh.points[points[i]];
        std::optional<Point<3>> target;
        if (is_kept[points[i]])
          continue;
        if (with_creases && n_sharp[points[i]] > 0)
          {
            // Ends and branches of sharp edges are points of the first mesh, and so is where
            // they cross the border of a selection.
            if (n_sharp[points[i]] != 2 || !place.borders.empty())
              continue;
            target = place.surfaces.front()->nearest_on_crease(here);
            if (target && target->distance(here) > 0.5 * place.length)
              target.reset();
          }
        if (!target)
          {
            auto all = place.surfaces;
            all.insert(all.end(), place.borders.begin(), place.borders.end());
            target = find_foot(here, all, place.planes, place.length);
          }
        if (!target)
          ++n_lost;
        else if (target->distance(here) > worth_it * place.length)
          moves.push_back({points[i], *target});
      }
    MoveReport report = move_points(mesh, moves);
    report.n_held += n_lost;
    return report;
  }

  double
  BoundaryProjection::true_volume() const
  {
    return volume;
  }

  double
  BoundaryProjection::body_volume(const TetMesh &mesh) const
  {
    if (volume > 0.)
      return volume;
    std::vector<const CurvedSurface *> of_patch;
    for (const unsigned int s : surfaces_of_patches(mesh, surfaces))
      of_patch.push_back(s == none ? nullptr : surfaces[s].get());
    return curved_volume(mesh, of_patch);
  }

  std::unique_ptr<BoundaryProjection>
  make_projection(const scene::Scene &scene)
  {
    return scene.mesh.projection == Projection::none ? nullptr
                                                     : std::make_unique<BoundaryProjection>(scene);
  }

  scene::TetgenParameters
  quality_for_projection(const scene::TetgenParameters &parameters, const bool is_projected)
  {
    scene::TetgenParameters quality = parameters;
    if (is_projected)
      {
        quality.radius_edge_ratio = std::max(parameters.radius_edge_ratio, 2.);
        quality.dihedral_angle    = 0.;
      }
    return quality;
  }

  std::function<void(TetMesh &)>
  project_on(const BoundaryProjection *projection)
  {
    if (projection == nullptr)
      return {};
    return [projection](TetMesh &mesh) { projection->project(mesh); };
  }
} // namespace tetradapt::mesh
