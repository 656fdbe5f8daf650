// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/geometry/remeshing.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/geometry/surface_intersections.h"

#include "cgal_surface.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace tetradapt::geometry
{
  namespace
  {
    namespace pmp = CGAL::Polygon_mesh_processing;
    using core::InputError;

    constexpr unsigned int n_rounds       = 3;
    constexpr double       most_triangles = 2e7;
    constexpr unsigned int most_repairs   = 5;
    constexpr double       most_drift     = 0.1; ///< relative change of the volume

    /** Sharp edges that extend over fewer edge lengths than this are noise. */
    constexpr double least_feature = 4.;

    /** Part number of triangles that the repair made. */
    constexpr std::size_t unknown_part = std::numeric_limits<std::size_t>::max();

    using EdgeMap   = CgalSurface::Property_map<CgalSurface::Edge_index, bool>;
    using VertexMap = CgalSurface::Property_map<CgalSurface::Vertex_index, bool>;
    using FaceMap   = CgalSurface::Property_map<CgalSurface::Face_index, std::size_t>;

    void
    check_parameters(const CheckedSurface &surface,
                     double                edge_length,
                     double                feature_angle,
                     const std::string    &what)
    {
      if (!(edge_length > 0.) || !std::isfinite(edge_length))
        throw InputError("The edge length for the remeshing of " + what
                         + " must be positive and finite (Mesh/Surface edge length).");
      if (!(feature_angle > 0.) || !(feature_angle <= 180.))
        throw InputError("The feature angle for the remeshing of " + what
                         + " must be above 0 and at most 180 degrees (Mesh/Feature angle).");
      const double n_triangles = surface.area / (std::sqrt(3.) / 4. * edge_length * edge_length);
      std::ostringstream message;
      if (n_triangles > most_triangles)
        message << "An edge length of " << edge_length << " asks for about " << n_triangles
                << " triangles on " << what << "; at most " << most_triangles
                << " are made. Raise Mesh/Surface edge length.";
      else if (n_triangles < 8.)
        message << "An edge length of " << edge_length << " is too long for " << what
                << ", whose area is " << surface.area << ". Lower Mesh/Surface edge length.";
      if (!message.str().empty())
        throw InputError(message.str());
    }

    /** Marks the edges between triangles of different ids. */
    void
    mark_id_borders(const CgalSurface &mesh, const std::vector<int> &ids, EdgeMap &feature)
    {
      if (ids.empty())
        return;
      for (const auto edge : mesh.edges())
        {
          const auto half = mesh.halfedge(edge);
          if (ids[mesh.face(half).idx()] != ids[mesh.face(mesh.opposite(half)).idx()])
            feature[edge] = true;
        }
    }

    /** Unmarks sharp edges that hang together over less than @p extent. */
    void
    drop_small_features(const CgalSurface &mesh, double extent, EdgeMap &feature)
    {
      std::vector<std::size_t> parent(mesh.num_vertices());
      std::iota(parent.begin(), parent.end(), std::size_t(0));
      const auto root = [&](std::size_t i) {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      };
      const auto ends = [&](CgalSurface::Edge_index edge) {
        return std::make_pair(mesh.vertex(edge, 0), mesh.vertex(edge, 1));
      };
      for (const auto edge : mesh.edges())
        if (feature[edge])
          parent[root(ends(edge).first.idx())] = root(ends(edge).second.idx());

      std::vector<CGAL::Bbox_3> boxes(mesh.num_vertices());
      for (const auto vertex : mesh.vertices())
        boxes[root(vertex.idx())] += mesh.point(vertex).bbox();
      for (const auto edge : mesh.edges())
        if (feature[edge])
          {
            const CGAL::Bbox_3 &box = boxes[root(ends(edge).first.idx())];
            feature[edge] = std::hypot(box.x_span(), box.y_span(), box.z_span()) >= extent;
          }
    }

    /** Marks the points that no feature line may pass over: its ends, branches,
     * and bends sharper than @p feature_angle degrees. */
    void
    mark_corners(const CgalSurface &mesh,
                 const EdgeMap     &feature,
                 double             feature_angle,
                 VertexMap         &corner)
    {
      const double largest_cosine = std::cos((180. - feature_angle) * M_PI / 180.);
      for (const auto vertex : mesh.vertices())
        {
          std::vector<CgalKernel::Vector_3> directions;
          for (const auto half : mesh.halfedges_around_target(mesh.halfedge(vertex)))
            if (feature[mesh.edge(half)])
              directions.push_back(mesh.point(mesh.source(half)) - mesh.point(vertex));
          if (directions.size() == 2)
            corner[vertex]
              = directions[0] * directions[1]
                > largest_cosine
                    * std::sqrt(directions[0].squared_length() * directions[1].squared_length());
          else
            corner[vertex] = !directions.empty();
        }
    }

    /** For each part that feature lines surround the id of its triangles. */
    std::vector<int>
    ids_of_parts(const CgalSurface &mesh, const FaceMap &part, const std::vector<int> &ids)
    {
      std::vector<int> result;
      for (const auto face : mesh.faces())
        {
          if (part[face] >= result.size())
            result.resize(part[face] + 1, 0);
          result[part[face]] = ids[face.idx()];
        }
      return result;
    }

    /** Gives triangles that the repair made the part of a neighbour. */
    void
    fill_unknown_parts(const CgalSurface &mesh, FaceMap &part)
    {
      for (bool changed = true; changed;)
        {
          changed = false;
          for (const auto face : mesh.faces())
            for (const auto half : mesh.halfedges_around_face(mesh.halfedge(face)))
              {
                const std::size_t other = part[mesh.face(mesh.opposite(half))];
                if (part[face] != unknown_part || other == unknown_part)
                  continue;
                part[face] = other;
                changed    = true;
              }
        }
    }

    SurfaceMesh
    from_cgal(const CgalSurface &mesh, const FaceMap &part, const std::vector<int> &part_ids)
    {
      SurfaceMesh               result;
      std::vector<unsigned int> number(mesh.num_vertices() + mesh.number_of_removed_vertices());
      for (const auto vertex : mesh.vertices())
        {
          number[vertex.idx()] = result.points.size();
          const CgalPoint &p   = mesh.point(vertex);
          result.points.emplace_back(p.x(), p.y(), p.z());
        }
      for (const auto face : mesh.faces())
        {
          std::array<unsigned int, 3> triangle{};
          unsigned int                k = 0;
          for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
            triangle[k++ % 3] = number[vertex.idx()];
          result.triangles.push_back(triangle);
          if (!part_ids.empty())
            result.ids.push_back(part[face] < part_ids.size() ? part_ids[part[face]] : 0);
        }
      return result;
    }

    /** Remeshes a checked surface and repairs the result; does not check it. */
    SurfaceMesh
    remesh_with_cgal(const SurfaceMesh &surface,
                     double             edge_length,
                     double             feature_angle,
                     unsigned int      &n_intersections)
    {
      CgalSurface mesh = to_cgal(surface);
      EdgeMap     feature
        = mesh.add_property_map<CgalSurface::Edge_index, bool>("e:feature", false).first;
      VertexMap corner
        = mesh.add_property_map<CgalSurface::Vertex_index, bool>("v:corner", false).first;
      FaceMap part
        = mesh.add_property_map<CgalSurface::Face_index, std::size_t>("f:part", unknown_part).first;

      if (feature_angle < 180.)
        {
          pmp::detect_sharp_edges(mesh, feature_angle, feature);
          drop_small_features(mesh, least_feature * edge_length, feature);
        }
      mark_id_borders(mesh, surface.ids, feature);
      mark_corners(mesh, feature, feature_angle, corner);
      pmp::connected_components(mesh, part, CGAL::parameters::edge_is_constrained_map(feature));
      std::vector<int> part_ids;
      if (!surface.ids.empty())
        part_ids = ids_of_parts(mesh, part, surface.ids);

      // What cannot be repaired the first time often can after another round.
      for (unsigned int i = 0; i < most_repairs; ++i)
        {
          pmp::isotropic_remeshing(mesh.faces(),
                                   edge_length,
                                   mesh,
                                   CGAL::parameters::number_of_iterations(i == 0 ? n_rounds : 1)
                                     .edge_is_constrained_map(feature)
                                     .vertex_is_constrained_map(corner)
                                     .face_patch_map(part)
                                     .protect_constraints(false));
          const auto n = self_intersections(from_cgal(mesh, part, {})).size();
          n_intersections += n;
          if (n == 0)
            break;
          const bool repaired = remove_self_intersections(mesh);
          fill_unknown_parts(mesh, part);
          if (repaired)
            break;
        }
      return from_cgal(mesh, part, part_ids);
    }

    RemeshedSurface
    attempt(const CheckedSurface &before,
            double                edge_length,
            double                feature_angle,
            const std::string    &what)
    {
      RemeshedSurface result;
      result.surface = check_surface(
        remesh_with_cgal(before.mesh, edge_length, feature_angle, result.repaired_intersections),
        what + " after remeshing");
      result.volume_change = result.surface.volume / before.volume - 1.;
      return result;
    }

    /** Tries with and without sharp edges, and with slightly shorter edges: whether
     * triangles come to intersect at a crease is a matter of chance. CGAL's failed
     * assertions are errors of the input, too. */
    RemeshedSurface
    attempt_all(const CheckedSurface &before,
                double                edge_length,
                double                feature_angle,
                const std::string    &what)
    {
      std::string reason;
      for (const double angle : {feature_angle, 180.})
        for (const double factor : {1., 0.95, 0.9, 0.85, 0.8})
          try
            {
              RemeshedSurface result = attempt(before, factor * edge_length, angle, what);
              result.edge_length     = factor * edge_length;
              result.kept_features   = angle == feature_angle;
              return result;
            }
          catch (const InputError &error)
            {
              reason = error.what();
            }
          catch (const std::logic_error &error)
            {
              reason = std::string("CGAL reports: ") + error.what();
            }
      std::ostringstream message;
      message << "Remeshing " << what << " to edges of length " << edge_length
              << " does not give a usable surface: lower Mesh/Surface edge length. " << reason;
      throw InputError(message.str());
    }
  } // namespace

  RemeshedSurface
  remesh(const SurfaceMesh &surface,
         double             edge_length,
         double             feature_angle,
         const std::string &what)
  {
    const CheckedSurface before = check_surface(surface, what);
    check_parameters(before, edge_length, feature_angle, what);
    const RemeshedSurface after = attempt_all(before, edge_length, feature_angle, what);
    if (std::abs(after.volume_change) > most_drift
        || after.surface.n_components != before.n_components)
      {
        std::ostringstream message;
        message << "Remeshing " << what << " to edges of length " << edge_length
                << " changes its volume from " << before.volume << " to " << after.surface.volume
                << ": lower Mesh/Surface edge length.";
        throw InputError(message.str());
      }
    return after;
  }
} // namespace tetradapt::geometry
