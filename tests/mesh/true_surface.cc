// SPDX-License-Identifier: AGPL-3.0-or-later
// The true surface over the faces of a projected boundary: on an ellipsoid its points and
// normals are exact however coarse the faces, on a triangulated sphere they are as good as its
// triangles; without a projection and on flat parts they are the face's own.

#include "tetradapt/mesh/true_surface.h"
#include "tetradapt/geometry/surface_io.h"
#include "tetradapt/io/volume_reader.h"
#include "tetradapt/mesh/boundary_projection.h"
#include "tetradapt/mesh/red_refinement.h"

#include <cmath>
#include <fstream>
#include <iostream>
#include <map>

using namespace tetradapt;
using mesh::Point;
using mesh::Tensor;
using mesh::TetMesh;

namespace
{
  void
  check(const std::string &what, const bool holds)
  {
    std::cout << what << ": " << (holds ? "yes" : "NO") << std::endl;
  }

  struct Errors
  {
    double distance = 0., normal = 0., facet = 0.;
  };

  /** Largest errors over the faces on the walls x^2/a^2 + ... = 1 and 4, at points inside. */
  Errors
  errors_of(const TetMesh               &mesh,
            const mesh::TrueSurface     &surface,
            const std::array<double, 3> &axes)
  {
    Errors largest;
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      if (const int id = mesh.patches[mesh.faces[f].patch].boundary_id; id <= 2)
        for (unsigned int q = 0; q < 4; ++q)
          {
            Tensor<1, 3> x;
            for (unsigned int i = 0; i < 3; ++i)
              x += (q == 3   ? 1. / 3.
                    : i == q ? 0.6
                             : 0.2)
                   * Tensor<1, 3>(mesh.points[mesh.faces[f].vertices[i]]);
            const auto   at    = surface.at(f, Point<3>(x));
            double       level = 0.;
            Tensor<1, 3> normal;
            for (unsigned int d = 0; d < 3; ++d)
              {
                level += std::pow(at.point[d] / axes[d], 2);
                normal[d] = (id == 1 ? -1. : 1.) * at.point[d] / std::pow(axes[d], 2);
              }
            const Tensor<1, 3> area = mesh::face_area_vector(mesh, mesh.faces[f]);
            normal /= normal.norm();
            largest.distance = std::max(largest.distance, std::abs(std::sqrt(level) - id));
            largest.normal   = std::max(largest.normal, (at.normal - normal).norm());
            largest.facet    = std::max(largest.facet, (area / area.norm() - normal).norm());
          }
    return largest;
  }

  /** How far the surface over a point of a face is from the face. */
  double
  difference_to_face(const TetMesh &mesh, const mesh::TrueSurface &surface, const unsigned int f)
  {
    const Tensor<1, 3> area = mesh::face_area_vector(mesh, mesh.faces[f]);
    const Tensor<1, 3> x    = 0.2 * Tensor<1, 3>(mesh.points[mesh.faces[f].vertices[0]])
                           + 0.3 * Tensor<1, 3>(mesh.points[mesh.faces[f].vertices[1]])
                           + 0.5 * Tensor<1, 3>(mesh.points[mesh.faces[f].vertices[2]]);
    const auto at = surface.at(f, Point<3>(x));
    return std::max(at.point.distance(Point<3>(x)), (at.normal - area / area.norm()).norm());
  }

  void
  ellipsoid()
  {
    scene::MeshParameters parameters;
    parameters.projection = scene::MeshParameters::Projection::expression;
    parameters.projection_functions
      = {"(x/1.2)^2 + y^2 + (z/0.9)^2 - 1", "(x/1.2)^2 + y^2 + (z/0.9)^2 - 4"};
    scene::Scene scene;
    scene.mesh = parameters;
    const mesh::BoundaryProjection projection(scene);
    TetMesh mesh = io::read_volume_mesh(SOURCE_DIR "/../../meshes/ellipsoid_octant.msh");
    projection.assign(mesh);
    projection.project(mesh);
    double before = 0.;
    for (unsigned int level = 0; level < 4; ++level)
      {
        const mesh::TrueSurface surface(parameters, mesh);
        const Errors            errors = errors_of(mesh, surface, {{1.2, 1., 0.9}});
        check("ellipsoid: exact points and normals",
              errors.distance < 1e-10 && errors.normal < 1e-7);
        if (level > 1)
          std::cout << "  order of the faces' own normals: "
                    << std::lround(std::log2(before / errors.facet)) << std::endl;
        before       = errors.facet;
        double flat  = 0.;
        bool   right = true;
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          {
            const bool curved = mesh.patches[mesh.faces[f].patch].boundary_id <= 2;
            right             = right && surface.is_projected(f) == curved;
            if (!curved)
              flat = std::max(flat, difference_to_face(mesh, surface, f));
          }
        check("  planes stay planes", right && flat == 0.);
        mesh = mesh::red_refine(mesh, nullptr);
        projection.project(mesh);
      }
    const mesh::TrueSurface none(scene::MeshParameters(), mesh);
    double                  largest = 0.;
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      largest = std::max(largest, difference_to_face(mesh, none, f));
    check("no projection: the faces", largest == 0.);
  }

  /** A sphere of radius 1 as an octahedron whose triangles are cut into four @p n times. */
  geometry::SurfaceMesh
  sphere(const unsigned int n)
  {
    geometry::SurfaceMesh surface;
    for (unsigned int d = 0; d < 3; ++d)
      for (const double sign : {1., -1.})
        {
          Point<3> p;
          p[d] = sign;
          surface.points.push_back(p);
        }
    for (unsigned int i : {0, 1})
      for (unsigned int j : {2, 3})
        for (unsigned int k : {4, 5})
          if ((i + j + k) % 2 == 0)
            surface.triangles.push_back({{i, j, k}});
          else
            surface.triangles.push_back({{i, k, j}});
    for (unsigned int level = 0; level < n; ++level)
      {
        std::map<std::pair<unsigned int, unsigned int>, unsigned int> middles;
        const auto middle = [&](unsigned a, unsigned b) {
          const auto found = middles.emplace(std::make_pair(std::min(a, b), std::max(a, b)),
                                             surface.points.size());
          if (found.second)
            {
              Tensor<1, 3> m = Tensor<1, 3>(surface.points[a]) + Tensor<1, 3>(surface.points[b]);
              surface.points.push_back(Point<3>(m / m.norm()));
            }
          return found.first->second;
        };
        auto triangles = std::move(surface.triangles);
        surface.triangles.clear();
        for (const auto &t : triangles)
          {
            const unsigned int a = middle(t[0], t[1]), b = middle(t[1], t[2]),
                               c = middle(t[2], t[0]);
            surface.triangles.push_back({{t[0], a, c}});
            surface.triangles.push_back({{t[1], b, a}});
            surface.triangles.push_back({{t[2], c, b}});
            surface.triangles.push_back({{a, b, c}});
          }
      }
    return surface;
  }

  void
  write_off(const std::string &file, const geometry::SurfaceMesh &surface)
  {
    std::ofstream out(file);
    out.precision(17);
    out << "OFF\n" << surface.points.size() << ' ' << surface.triangles.size() << " 0\n";
    for (const auto &p : surface.points)
      out << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (const auto &t : surface.triangles)
      out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }

  /** The surface itself cut once more, as the boundary of a mesh: from the middle. */
  TetMesh
  ball(const geometry::SurfaceMesh &surface)
  {
    TetMesh mesh;
    mesh.points = surface.points;
    mesh.points.push_back(Point<3>());
    mesh.patches.resize(1);
    const unsigned int centre = mesh.points.size() - 1;
    for (const auto &t : surface.triangles)
      {
        mesh.cells.push_back({{centre, t[0], t[1], t[2]}});
        mesh.regions.push_back(0);
        mesh::BoundaryFace face;
        face.vertices = t;
        mesh.faces.push_back(face);
      }
    return mesh;
  }

  void
  triangulated(const unsigned int levels, const std::string &what, const double bound)
  {
    scene::MeshParameters parameters;
    parameters.projection      = scene::MeshParameters::Projection::surface;
    parameters.projection_file = "sphere.off";
    parameters.source          = scene::MeshSource::file;
    write_off("sphere.off", sphere(3));
    scene::Scene scene;
    scene.mesh = parameters;
    const mesh::BoundaryProjection projection(scene);
    TetMesh                        mesh = ball(sphere(levels));
    projection.assign(mesh);
    projection.project(mesh);
    const mesh::TrueSurface surface(parameters, mesh);
    double                  largest = 0.;
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      {
        Tensor<1, 3> x;
        for (unsigned int i = 0; i < 3; ++i)
          x += Tensor<1, 3>(mesh.points[mesh.faces[f].vertices[i]]) / 3.;
        const auto at = surface.at(f, Point<3>(x));
        largest       = std::max(largest, (at.normal - Tensor<1, 3>(x) / x.norm()).norm());
      }
    std::cout << "triangulated sphere, " << what << ": normals within " << bound << ": "
              << (largest < bound ? "yes" : "NO, " + std::to_string(largest)) << std::endl;
  }
} // namespace

int
main()
{
  ellipsoid();
  triangulated(1, "coarse faces", 0.12);
  triangulated(3, "faces as large as its triangles", 0.05);
}
