// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/sliding_normals.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

namespace tetradapt::mechanics
{
  namespace
  {
    constexpr double degrees = 180. / dealii::numbers::PI;

    /** From a place on the way to the middle of a face: where the normal of a triangulated surface
     * is looked at, whose own vertices and edges have none. */
    constexpr double inside = 0.05;

    /** Faces that meet at more are worth a question, unless a surface is known. */
    constexpr double suspicious_angle = 30.;

    bool
    share_edge(const mesh::BoundaryFace &a, const mesh::BoundaryFace &b)
    {
      unsigned int common = 0;
      for (const unsigned int v : a.vertices)
        common += std::count(b.vertices.begin(), b.vertices.end(), v);
      return common >= 2;
    }

    /** Faces with a normal in common. */
    struct Cluster
    {
      Tensor<1, 3>              area;
      std::set<unsigned int>    supports;
      std::vector<Tensor<1, 3>> normals;
    };
  } // namespace

  SlidingNormals::SlidingNormals(const std::vector<scene::SupportParameters> &supports,
                                 const mesh::TetMesh                         &mesh,
                                 const scene::MeshParameters                 &parameters)
    : mesh(mesh), on_patch(mesh.patches.size()),
      feature_cosine(std::cos(parameters.feature_angle / degrees)),
      by_facets(parameters.projection == scene::MeshParameters::Projection::surface)
  {
    for (unsigned int s = 0; s < supports.size(); ++s)
      if (supports[s].type == scene::SupportType::sliding)
        for (unsigned int p = 0; p < mesh.patches.size(); ++p)
          {
            const auto &names = mesh.patches[p].selections;
            if (std::count(names.begin(), names.end(), "Supports/" + supports[s].name) > 0)
              on_patch[p].push_back(s);
          }
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      if (!on_patch[mesh.faces[f].patch].empty())
        sliding_faces.push_back(f);
    if (!sliding_faces.empty())
      surface = std::make_unique<mesh::TrueSurface>(parameters, mesh);
  }

  std::vector<unsigned int>
  SlidingNormals::supports_of(const unsigned int face) const
  {
    return on_patch[mesh.faces[face].patch];
  }

  Tensor<1, 3>
  SlidingNormals::normal_at(const Point<3> &place, const unsigned int face) const
  {
    if (!surface->is_projected(face))
      {
        const Tensor<1, 3> area = mesh::face_area_vector(mesh, mesh.faces[face]);
        return area / area.norm();
      }
    Point<3> point = place;
    if (by_facets)
      {
        Tensor<1, 3> middle;
        for (const unsigned int v : mesh.faces[face].vertices)
          middle += mesh.points[v] / 3.;
        point += inside * (Point<3>(middle) - place);
      }
    return surface->at(face, point).normal;
  }

  std::vector<SlidingNormals::Direction>
  SlidingNormals::at(const Point<3> &place, const std::vector<unsigned int> &around) const
  {
    std::vector<Tensor<1, 3>> normals;
    for (const unsigned int face : around)
      normals.push_back(normal_at(place, face));

    // Faces that meet at an edge and at less than the feature angle belong together.
    std::vector<unsigned int> cluster_of(around.size());
    std::iota(cluster_of.begin(), cluster_of.end(), 0);
    const auto join = [&cluster_of](const unsigned int from, const unsigned int to) {
      std::replace(cluster_of.begin(), cluster_of.end(), from, to);
    };
    for (unsigned int i = 0; i < around.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        if (cluster_of[i] != cluster_of[j] && normals[i] * normals[j] > feature_cosine
            && share_edge(mesh.faces[around[i]], mesh.faces[around[j]]))
          join(cluster_of[i], cluster_of[j]);
    std::map<unsigned int, Cluster> clusters;
    for (unsigned int i = 0; i < around.size(); ++i)
      {
        Cluster     &cluster  = clusters[cluster_of[i]];
        const auto   supports = supports_of(around[i]);
        const double area     = mesh::face_area_vector(mesh, mesh.faces[around[i]]).norm();
        cluster.area += area * normals[i];
        cluster.normals.push_back(normals[i]);
        cluster.supports.insert(supports.begin(), supports.end());
      }

    std::vector<Direction> result;
    std::vector<Cluster>   merged;
    for (const auto &entry : clusters)
      {
        const Cluster &cluster = entry.second;
        // Those of flat parts that meet in a point only, such as two halves of a plane.
        const auto other
          = std::find_if(merged.begin(), merged.end(), [&](const Cluster &candidate) {
              return candidate.area * cluster.area
                     > feature_cosine * candidate.area.norm() * cluster.area.norm();
            });
        if (other == merged.end())
          merged.push_back(cluster);
        else
          {
            other->area += cluster.area;
            other->normals.insert(other->normals.end(),
                                  cluster.normals.begin(),
                                  cluster.normals.end());
            other->supports.insert(cluster.supports.begin(), cluster.supports.end());
          }
      }
    for (const Cluster &cluster : merged)
      if (const double size = cluster.area.norm(); size > 0.)
        {
          Direction direction{cluster.area / size, cluster.supports};
          for (const Tensor<1, 3> &normal : cluster.normals)
            direction.spread = std::max(direction.spread, (normal - direction.normal).norm());
          result.push_back(direction);
        }
    return result;
  }

  double
  SlidingNormals::largest_averaged_angle() const
  {
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> first_face; // of edges
    double                                                        smallest = 1.;
    for (const unsigned int f : sliding_faces)
      if (!surface->is_projected(f))
        for (unsigned int i = 0; i < 3; ++i)
          {
            const auto &v              = mesh.faces[f].vertices;
            const auto  edge           = std::minmax(v[i], v[(i + 1) % 3]);
            const auto [other, is_new] = first_face.emplace(edge, f);
            if (is_new)
              continue;
            const Tensor<1, 3> a      = mesh::face_area_vector(mesh, mesh.faces[f]);
            const Tensor<1, 3> b      = mesh::face_area_vector(mesh, mesh.faces[other->second]);
            const double       cosine = a * b / (a.norm() * b.norm());
            if (cosine > feature_cosine)
              smallest = std::min(smallest, cosine);
          }
    return degrees * std::acos(std::min(1., smallest));
  }

  std::vector<std::string>
  sliding_warnings(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    std::vector<std::string> warnings;
    for (const auto &support : scene.supports)
      {
        if (support.type != scene::SupportType::sliding)
          continue;
        const double angle = SlidingNormals({support}, mesh, scene.mesh).largest_averaged_angle();
        if (angle <= suspicious_angle)
          continue;
        std::ostringstream text;
        text.precision(3);
        text
          << "Supports/" << support.name << ": faces that slide meet at " << angle
          << " degrees, which counts as an approximation of a curved wall: the nodes there slide "
             "along a mean of both. If it is a true edge, set Mesh/Feature angle below that; if "
             "not, use a finer surface or Mesh/Projection.";
        warnings.push_back(text.str());
      }
    return warnings;
  }
} // namespace tetradapt::mechanics
