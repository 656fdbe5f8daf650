// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/springs.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/expression.h"
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/mechanics/supports.h"
#include "tetradapt/mechanics/surface_loads.h"
#include "tetradapt/mesh/finalize.h"
#include "tetradapt/mesh/true_surface.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace tetradapt::mechanics
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Of the integral of a stiffness, what may be unknown of it. */
    constexpr double least_known = 1e-4;

    Point<3>
    position(const mesh::TetMesh         &mesh,
             const mesh::BoundaryFace    &face,
             const std::array<double, 3> &b)
    {
      Point<3> x;
      for (unsigned int i = 0; i < 3; ++i)
        x += b[i] * Tensor<1, 3>(mesh.points[face.vertices[i]]);
      return x;
    }

    bool
    selects(const mesh::TetMesh &mesh, const unsigned int face, const std::string &name)
    {
      const auto &selections = mesh.patches[mesh.faces[face].patch].selections;
      return std::find(selections.begin(), selections.end(), name) != selections.end();
    }
  } // namespace

  /** The springs of one support. */
  struct Springs::Foundation
  {
    Foundation(const scene::SupportParameters &parameters, const unsigned int support)
      : support(support), name("Supports/" + parameters.name),
        along_normal(parameters.spring.direction == scene::SpringDirection::normal),
        stiffness(parameters.spring.stiffness, name + "/Stiffness"),
        ground(parameters.displacement, name + "/Displacement")
    {
    }

    dealii::SymmetricTensor<2, 3>
    tensor(const double k, const Tensor<1, 3> &normal) const
    {
      return along_normal ? k * dealii::SymmetricTensor<2, 3>(outer_product(normal, normal))
                          : k * dealii::unit_symmetric_tensor<3>();
    }

    unsigned int           support;
    std::string            name;
    bool                   along_normal;
    core::Expression       stiffness;
    core::VectorExpression ground;
  };

  namespace
  {
    /** The largest displacement of the ground at the vertices of the faces of a support. */
    double
    ground_scale(const core::VectorExpression &ground,
                 const std::string            &name,
                 const mesh::TetMesh          &mesh)
    {
      double largest = 0.;
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        if (selects(mesh, f, name))
          for (const unsigned int v : mesh.faces[f].vertices)
            largest = std::max(largest, ground(mesh.points[v]).norm());
      return largest;
    }

    /**
     * What is looked at to find the points on the faces: k and, where the ground's displacement
     * varies, k times two sums of its components, of the size of k: a feature of any component
     * is seen in one of them.
     */
    scene::LoadParameters
    density_of(const scene::SupportParameters &support,
               const core::VectorExpression   &ground,
               const mesh::TetMesh            &mesh)
    {
      scene::LoadParameters density;
      density.name  = support.name;
      density.type  = scene::LoadType::traction;
      const auto &k = support.spring.stiffness;
      density.value = {{k, "0", "0"}};
      const double size
        = ground.is_constant() ? 0. : ground_scale(ground, "Supports/" + support.name, mesh);
      if (size == 0.)
        return density;
      std::ostringstream scale;
      scale.precision(17);
      scale << size;
      const auto sum = [&](const std::string &a, const std::string &b) {
        return "(" + k + ") * ((" + a + ") + 0.7 * (" + b + ")) / " + scale.str();
      };
      density.value[1] = sum(support.displacement[0], support.displacement[1]);
      density.value[2] = sum(support.displacement[2], support.displacement[1]);
      return density;
    }
  } // namespace

  Springs::Springs(const scene::Scene &scene, const mesh::TetMesh &mesh)
    : mesh(mesh), support_count(scene.supports.size())
  {
    for (unsigned int s = 0; s < scene.supports.size(); ++s)
      if (scene.supports[s].type == scene::SupportType::spring)
        foundations.push_back(std::make_unique<Foundation>(scene.supports[s], s));
    if (foundations.empty())
      return;
    sample(scene);
    check_stiffness(scene);
    std::stable_sort(face_springs.begin(), face_springs.end(), [](const Face &a, const Face &b) {
      return a.face < b.face;
    });
  }

  Springs::~Springs() = default;

  void
  Springs::sample(const scene::Scene &scene)
  {
    std::vector<scene::LoadParameters> densities;
    for (const auto &foundation : foundations)
      densities.push_back(
        density_of(scene.supports[foundation->support], foundation->ground, mesh));
    const SurfaceLoads    sampler(densities, "Supports", "Stiffness", scene.mesh, mesh);
    SurfaceLoads::Samples samples;
    for (unsigned int number = 0; number < foundations.size(); ++number)
      {
        const Foundation &foundation = *foundations[number];
        double            all = 0., unknown = 0.;
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          {
            if (!selects(mesh, f, foundation.name))
              continue;
            const Tensor<1, 3> area = mesh::face_area_vector(mesh, mesh.faces[f]);
            unknown += area.norm() * sampler.sample(number, f, samples);
            const bool is_curved = foundation.along_normal && sampler.surface().is_projected(f);
            Face       face{f, foundation.support, {}};
            face.points.reserve(samples.size());
            for (const auto &sample : samples)
              {
                const Point<3>     x = position(mesh, mesh.faces[f], sample.b);
                const double       k = sample.value[0];
                const Tensor<1, 3> normal
                  = is_curved ? sampler.surface().at(f, x).normal : area / area.norm();
                if (!(k >= 0.))
                  {
                    std::ostringstream message;
                    message << foundation.name << "/Stiffness: it is " << k << " at "
                            << mesh::to_string(x) << ". It must not be negative.";
                    throw core::InputError(message.str());
                  }
                face.points.push_back({sample.b,
                                       area.norm() * sample.weight,
                                       foundation.tensor(k, normal),
                                       foundation.ground(x)});
                all += area.norm() * sample.weight * k;
                moved = moved || face.points.back().ground != Tensor<1, 3>();
              }
            face_springs.push_back(std::move(face));
          }
        if (const std::string remark = sampler.remark(number); !remark.empty())
          all_remarks.push_back(remark);
        if (unknown > least_known * all)
          {
            std::ostringstream remark;
            remark.precision(2);
            remark << foundation.name
                   << "/Stiffness: it varies so fast that its integral is known to "
                   << 100. * unknown / all << " % only. Make it smoother, or the mesh finer.";
            all_remarks.push_back(remark.str());
          }
      }
  }

  void
  Springs::check_stiffness(const scene::Scene &scene) const
  {
    std::vector<double> sums(scene.supports.size(), 0.);
    for (const Face &face : face_springs)
      for (const auto &point : face.points)
        sums[face.support] += point.weight * trace(point.stiffness);
    for (const auto &foundation : foundations)
      if (!(sums[foundation->support] > 0.))
        throw core::InputError(
          foundation->name
          + "/Stiffness: it is zero on all of its faces. Give a stiffness that "
            "is positive somewhere, or remove the support.");
  }

  std::pair<std::vector<Springs::Face>::const_iterator, std::vector<Springs::Face>::const_iterator>
  Springs::on_face(const unsigned int face) const
  {
    const auto begin
      = std::lower_bound(face_springs.begin(),
                         face_springs.end(),
                         face,
                         [](const Face &f, const unsigned int number) { return f.face < number; });
    auto end = begin;
    while (end != face_springs.end() && end->face == face)
      ++end;
    return {begin, end};
  }

  Tensor<1, 3>
  Springs::traction(const unsigned int  face,
                    const Point<3>     &point,
                    const Tensor<1, 3> &normal,
                    const Tensor<1, 3> &displacement) const
  {
    Tensor<1, 3> sum;
    const auto [begin, end] = on_face(face);
    for (auto spring = begin; spring != end; ++spring)
      {
        const auto &foundation
          = **std::find_if(foundations.begin(), foundations.end(), [&](const auto &f) {
              return f->support == spring->support;
            });
        sum += foundation.tensor(foundation.stiffness(point), normal)
               * (foundation.ground(point) - displacement);
      }
    return sum;
  }

  void
  face_shape_values(const unsigned int degree, const std::array<double, 3> &b, double *values)
  {
    for (unsigned int i = 0; i < 3; ++i)
      {
        values[i] = degree == 1 ? b[i] : b[i] * (2. * b[i] - 1.);
        if (degree == 2)
          values[3 + i] = 4. * b[i] * b[(i + 1) % 3];
      }
  }

  SpringForces
  spring_forces(const Springs &springs, const fem::Field &displacement)
  {
    SpringForces result;
    result.supports.resize(springs.n_supports());
    if (springs.empty())
      return result;
    const fem::Space    &space = displacement.space();
    const mesh::TetMesh &mesh  = space.tet_mesh();
    const unsigned int   n     = space.degree() == 1 ? 3 : 6;
    const auto           field_nodes
      = boundary_face_nodes(mesh, space.degree() == 1 ? nullptr : space.edge_table());
    result.nodal.reinit(space.vector_layout());
    std::array<unsigned int, 6> nodes{};
    std::array<Tensor<1, 3>, 6> values;
    double                      N[6];
    for (const Springs::Face &face : springs.faces())
      {
        bool has_own = false;
        for (unsigned int i = 0; i < n; ++i)
          {
            nodes[i] = space.local_node(field_nodes[face.face][i]);
            has_own  = has_own || nodes[i] < space.n_owned_nodes();
          }
        if (!has_own)
          continue;
        // The face's cell touches a node of this rank, so that all of them are here.
        for (unsigned int i = 0; i < n; ++i)
          values[i] = displacement.value(nodes[i]);
        const bool counts = nodes[0] < space.n_owned_nodes(); // on one rank only
        for (const Springs::Sample &point : face.points)
          {
            face_shape_values(space.degree(), point.b, N);
            Tensor<1, 3> u;
            for (unsigned int i = 0; i < n; ++i)
              u += N[i] * values[i];
            const Tensor<1, 3> force = point.weight * point.traction(u);
            for (unsigned int i = 0; i < n; ++i)
              if (nodes[i] < space.n_owned_nodes())
                for (unsigned int c = 0; c < 3; ++c)
                  result.nodal.local_element(3 * nodes[i] + c) += N[i] * force[c];
            if (!counts)
              continue;
            result.supports[face.support].add(position(mesh, mesh.faces[face.face], point.b),
                                              force);
            result.energy += 0.5 * (force * (point.ground - u));
          }
      }
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        Tensor<1, 3> force;
        for (unsigned int c = 0; c < 3; ++c)
          force[c] = result.nodal.local_element(3 * node + c);
        result.magnitude += force.norm();
      }
    const MPI_Comm communicator = space.communicator();
    for (Resultant &support : result.supports)
      support = sum(support, communicator);
    result.magnitude = dealii::Utilities::MPI::sum(result.magnitude, communicator);
    result.energy    = dealii::Utilities::MPI::sum(result.energy, communicator);
    return result;
  }

  namespace
  {
    /** Angles between neighbouring faces, in degrees, of which flat faces that stand for a curved
     * surface have one; a larger one is taken for an edge of the body. */
    constexpr double flat = 0.1, edge = 60.;

    /** Whether two faces of one spring support meet at such an angle. */
    bool
    is_curved(const mesh::TetMesh &mesh, const Springs &springs, const unsigned int support)
    {
      // Per edge between two of the faces, the normal of the first.
      std::map<std::pair<unsigned int, unsigned int>, Tensor<1, 3>> normals;
      for (const Springs::Face &face : springs.faces())
        {
          if (face.support != support)
            continue;
          Tensor<1, 3> normal = mesh::face_area_vector(mesh, mesh.faces[face.face]);
          normal /= normal.norm();
          const auto &v = mesh.faces[face.face].vertices;
          for (unsigned int i = 0; i < 3; ++i)
            {
              const auto [other, is_new]
                = normals.emplace(std::minmax(v[i], v[(i + 1) % 3]), normal);
              if (is_new)
                continue;
              const double sine   = dealii::cross_product_3d(normal, other->second).norm();
              const double degree = dealii::numbers::PI / 180.;
              if (normal * other->second > std::cos(edge * degree)
                  && sine > std::sin(flat * degree))
                return true;
            }
        }
      return false;
    }

    /** Whether other supports hold all that springs on a face resist. */
    bool
    is_held(const scene::Scene  &scene,
            const mesh::TetMesh &mesh,
            const unsigned int   face,
            const bool           along_normal)
    {
      const auto   is_set = [](const auto &component) { return component.has_value(); };
      Tensor<1, 3> free   = mesh::face_area_vector(mesh, mesh.faces[face]); // of the normal
      free /= free.norm();
      std::array<bool, 3> held{{false, false, false}};
      for (const auto &support : scene.supports)
        {
          if (!selects(mesh, face, "Supports/" + support.name))
            continue;
          const auto &t = support.rigid.translation, &R = support.rigid.rotation;
          if (support.type == scene::SupportType::rigid && std::all_of(t.begin(), t.end(), is_set)
              && std::all_of(R.begin(), R.end(), is_set))
            return true;
          if (support.type == scene::SupportType::sliding && along_normal)
            return true;
          for (unsigned int c = 0; c < 3; ++c)
            if (support.type == scene::SupportType::fixed && support.components[c])
              {
                held[c] = true;
                free[c] = 0.;
              }
        }
      return (held[0] && held[1] && held[2]) || (along_normal && free.norm() < 1e-3);
    }

    double
    largest_modulus(const scene::Scene &scene)
    {
      double largest = 0.;
      for (const auto &material : scene.materials)
        largest = std::max(largest, material.moduli_at_rest().young_modulus);
      return largest;
    }

    /** Of k L / E, with L the size of the body, and of least_stiffness() / (E L); measured in
     * doc/springs.md. */
    constexpr double doubtful_stiffness = 1e10, doubtful_softness = 1e-9, least_softness = 1e-12;
  } // namespace

  std::vector<std::string>
  check_springs(const scene::Scene &scene, const mesh::TetMesh &mesh)
  {
    const Springs            springs(scene, mesh);
    std::vector<std::string> warnings = springs.remarks();
    if (springs.empty())
      return warnings;
    const auto              box  = mesh::bounding_box(mesh);
    const double            size = box.first.distance(box.second);
    const mesh::TrueSurface surface(scene.mesh, mesh);
    for (unsigned int s = 0; s < scene.supports.size(); ++s)
      {
        const auto &support = scene.supports[s];
        if (support.type != scene::SupportType::spring)
          continue;
        const std::string path    = "Supports/" + support.name;
        double            largest = 0., area = 0., held_area = 0.;
        bool              all_project = true;
        for (const Springs::Face &face : springs.faces())
          if (face.support == s)
            {
              all_project       = all_project && surface.is_projected(face.face);
              const double size = mesh::face_area_vector(mesh, mesh.faces[face.face]).norm();
              area += size;
              held_area += is_held(scene,
                                   mesh,
                                   face.face,
                                   support.spring.direction == scene::SpringDirection::normal)
                             ? size
                             : 0.;
              for (const Springs::Sample &point : face.points)
                largest = std::max(largest, point.stiffness.norm());
            }
        const double ratio = largest * size / largest_modulus(scene);
        if (support.spring.direction == scene::SpringDirection::normal && !all_project
            && is_curved(mesh, springs, s))
          warnings.push_back(
            path
            + "/Direction: its faces stand for a curved surface, and the springs act along the "
              "normals of these flat faces: they also resist some sliding, and stiff ones hold it. "
              "Name the surface in Mesh/Projection.");
        if (held_area > 0.)
          {
            std::ostringstream text;
            text.precision(3);
            text << path << ": other supports hold what it resists on " << 100. * held_area / area
                 << " % of its area, where springs do nothing. Choose other faces for one of them.";
            warnings.push_back(text.str());
          }
        if (ratio > doubtful_stiffness)
          {
            std::ostringstream text;
            text << path << "/Stiffness: times the size of the body it is " << ratio
                 << " times the largest Young modulus: rounding spoils digits of the forces where "
                    "the ground moves. A ratio of 1e6 is practically rigid; or use Type = fixed.";
            warnings.push_back(text.str());
          }
      }
    const double body       = largest_modulus(scene) * size;
    const auto   prescribed = prescribe(scene.supports, mesh, nullptr, scene.mesh);
    check_rigid_motions(mesh, prescribed, &springs);
    const double softness = least_stiffness(mesh, prescribed, springs, body) / body;
    if (softness < doubtful_softness)
      {
        std::ostringstream text;
        text << "Supports: a rigid motion of the body is held by springs only, with " << softness
             << " of the stiffness that the body has of its own, its size times the Young modulus: "
                "rounding "
             << (softness < least_softness ? "hides" : "spoils digits of")
             << " strains and stresses. Make the springs stiffer, or hold this motion by fixed "
                "supports.";
        if (softness < least_softness)
          throw core::InputError(text.str());
        warnings.push_back(text.str());
      }
    return warnings;
  }
} // namespace tetradapt::mechanics
