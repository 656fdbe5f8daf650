// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/surface_loads.h"

#include "tetradapt/core/polynomial_text.h"
#include "tetradapt/mechanics/triangle_features.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::mechanics
{
  namespace
  {
    constexpr double default_spacing = 0.01; ///< of the body's diagonal
    /** Parts of faces are not cut below this part of the spacing. */
    constexpr double finest = 1. / 64.;
    /** The same for polynomials, of the body's diagonal. */
    constexpr double finest_of_polynomials = 0.02;

    std::array<std::string, 3>
    texts_of(const scene::LoadParameters &load)
    {
      return load.type == scene::LoadType::pressure
               ? std::array<std::string, 3>{{load.value[0], "0", "0"}}
               : load.value;
    }
  } // namespace

  struct SurfaceLoads::Load
  {
    Load(const scene::LoadParameters &load,
         const std::string           &section,
         const std::string           &parameter)
      : parameters(load), name(section + "/" + load.name), texts(texts_of(load)),
        value(texts, name + "/" + parameter), is_pressure(load.type == scene::LoadType::pressure),
        is_total(load.type == scene::LoadType::total_force), is_constant(value.is_constant()),
        uses_normal(value.uses_normal()),
        is_polynomial(std::all_of(texts.begin(), texts.end(), core::is_polynomial)),
        smallest_feature(load.smallest_feature)
    {
      if (is_constant)
        constant = value(Point<3>(), Tensor<1, 3>());
    }

    Tensor<1, 3>
    at(const Point<3> &point, const Tensor<1, 3> &normal) const
    {
      return is_constant ? constant : value(point, normal);
    }

    scene::LoadParameters      parameters;
    std::string                name;
    std::array<std::string, 3> texts;
    core::SurfaceExpression    value;
    bool                       is_pressure, is_total, is_constant, uses_normal, is_polynomial;
    double                     smallest_feature;
    Tensor<1, 3>               constant;
    /** Found when they are first needed. */
    mutable bool             is_looked_at = false;
    mutable double           wanted = 0., spacing = 0.; ///< of looks
    mutable double           largest = 0.;              ///< |density|
    mutable SamplingRules<3> rules;
    /** Of a total force. */
    mutable std::unique_ptr<ResultantTraction> resultant;
  };

  SurfaceLoads::SurfaceLoads(const scene::Scene &scene, const mesh::TetMesh &mesh)
    : SurfaceLoads(scene.loads, "Loads", "Value", scene.mesh, mesh)
  {
  }

  SurfaceLoads::SurfaceLoads(const std::vector<scene::LoadParameters> &densities,
                             const std::string                        &section,
                             const std::string                        &parameter,
                             const scene::MeshParameters              &mesh_parameters,
                             const mesh::TetMesh                      &mesh)
    : mesh(mesh), mesh_parameters(mesh_parameters), on_patch(mesh.patches.size())
  {
    for (unsigned int i = 0; i < densities.size(); ++i)
      {
        const auto &load = densities[i];
        if (!scene::acts_on_surface(load.type))
          continue;
        loads.emplace(i, std::make_unique<Load>(load, section, parameter));
        const std::string selection = section + "/" + load.name;
        for (unsigned int p = 0; p < mesh.patches.size(); ++p)
          {
            const auto &names = mesh.patches[p].selections;
            if (std::find(names.begin(), names.end(), selection) != names.end())
              on_patch[p].push_back(i);
          }
      }
  }

  SurfaceLoads::~SurfaceLoads() = default;

  Tensor<1, 3>
  SurfaceLoads::traction(const unsigned int  number,
                         const unsigned int  face,
                         const Point<3>     &point,
                         const Tensor<1, 3> &normal) const
  {
    if (const ResultantTraction *total = resultant(number))
      return total->value(point,
                          total->uses_normal() ? surface().at(face, point).normal : normal,
                          normal);
    const Load        &load  = *loads.at(number);
    const Tensor<1, 3> value = load.uses_normal ? load.at(point, surface().at(face, point).normal)
                                                : load.at(point, Tensor<1, 3>());
    return load.is_pressure ? -value[0] * normal : value;
  }

  Tensor<1, 3>
  SurfaceLoads::surface_traction(const unsigned int number, const mesh::SurfacePoint &at) const
  {
    if (const ResultantTraction *total = resultant(number))
      return total->value(at.point, at.normal, at.normal);
    const Load        &load  = *loads.at(number);
    const Tensor<1, 3> value = load.at(at.point, at.normal);
    return load.is_pressure ? -value[0] * at.normal : value;
  }

  bool
  SurfaceLoads::is_constant(const unsigned int number) const
  {
    const ResultantTraction *total = resultant(number);
    return total != nullptr ? total->is_constant() : loads.at(number)->is_constant;
  }

  Tensor<1, 3>
  SurfaceLoads::constant_traction(const unsigned int number, const Tensor<1, 3> &normal) const
  {
    if (const ResultantTraction *total = resultant(number))
      return total->value(Point<3>(), normal, normal);
    const Load &load = *loads.at(number);
    return load.is_pressure ? -load.constant[0] * normal : load.constant;
  }

  std::vector<unsigned int>
  SurfaceLoads::faces_of(const unsigned int number) const
  {
    std::vector<unsigned int> faces;
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      {
        const auto &numbers = on_face(f);
        if (std::find(numbers.begin(), numbers.end(), number) != numbers.end())
          faces.push_back(f);
      }
    return faces;
  }

  const ResultantTraction *
  SurfaceLoads::resultant(const unsigned int number) const
  {
    const Load &load = *loads.at(number);
    if (!load.is_total || load.resultant != nullptr)
      return load.resultant.get();
    const auto faces = faces_of(number);
    load.resultant   = std::make_unique<ResultantTraction>(
      load.parameters.total.distribution == scene::Distribution::even
          ? ResultantTraction::even(load.parameters, mesh, faces)
          : ResultantTraction::bearing(load.parameters, mesh, faces, surface(), sampler));
    return load.resultant.get();
  }

  void
  SurfaceLoads::look_at(const Load &load, const unsigned int number) const
  {
    const std::vector<unsigned int> faces = faces_of(number);
    // A face is looked at with the same number of points along all edges, so that a sliver
    // takes as many as a square on its longest one.
    double total_area = 0., squares = 0.;
    for (const unsigned int f : faces)
      {
        const auto x = corners_of(f);
        total_area += mesh::face_area_vector(mesh, mesh.faces[f]).norm();
        squares += std::max(
          {x[0].distance_square(x[1]), x[1].distance_square(x[2]), x[2].distance_square(x[0])});
      }
    const auto   box      = mesh::bounding_box(mesh);
    const double standard = default_spacing * box.first.distance(box.second);
    load.wanted = load.smallest_feature > 0. ? std::min(load.smallest_feature, standard) : standard;
    // One part and half a point of a lattice, twice, for each square of that spacing.
    load.spacing = std::max(load.wanted, std::sqrt(2. * squares / most_evaluations));

    // How large the load is: from the centroids of parts as small as the spacing.
    double sum = 0.;
    for (const unsigned int f : faces)
      {
        const std::array<Point<3>, 3> x    = corners_of(f);
        const Tensor<1, 3>            area = mesh::face_area_vector(mesh, mesh.faces[f]);
        const double                  size = area.norm();
        const double                  longest
          = std::max({x[0].distance(x[1]), x[1].distance(x[2]), x[2].distance(x[0])});
        const auto n
          = load.is_polynomial ? 1u : static_cast<unsigned int>(std::ceil(longest / load.spacing));
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; i + j < n; ++j)
            for (unsigned int turned = 0; turned < (i + j + 1 < n ? 2u : 1u); ++turned)
              {
                const double   shift = turned == 0 ? 1. / 3. : 2. / 3.;
                const double   s = (i + shift) / n, t = (j + shift) / n;
                const Point<3> p     = x[0] + s * (x[1] - x[0]) + t * (x[2] - x[0]);
                const double   value = traction(number, f, p, area / size).norm();
                sum += size / (double(n) * n) * value;
                load.largest = std::max(load.largest, value);
              }
      }
    load.rules.mean = total_area > 0. ? sum / total_area : 0.;

    double n_marks = 0.;
    if (!load.is_polynomial)
      for (const unsigned int f : faces)
        {
          const Tensor<1, 3> area = mesh::face_area_vector(mesh, mesh.faces[f]);
          const auto         density
            = [&](const Point<3> &x) { return traction(number, f, x, area / area.norm()); };
          n_marks += TriangleFeatures(corners_of(f), density, load.spacing, load.largest).n_marks();
        }
    // Two parts a point of the lattice, with 13 points each, if they are as long as its step.
    const double finer = n_marks > 0. ? std::sqrt(most_evaluations / (26. * n_marks)) : 1. / finest;
    // A polynomial that is mere rounding fits nowhere, however small the parts.
    load.rules.finest = load.is_polynomial ? finest_of_polynomials * box.first.distance(box.second)
                                           : load.spacing / std::clamp(finer, 0.5, 1. / finest);
    load.rules.straight = load.is_polynomial ? 0. : 0.5 * load.spacing;
    load.is_looked_at   = true;
  }

  double
  SurfaceLoads::sample_carefully(const Load                        &load,
                                 const unsigned int                 number,
                                 const std::array<Point<3>, 3>     &corners,
                                 const DensitySampler<3>::Function &density,
                                 Samples                           &samples) const
  {
    if (!load.is_looked_at)
      look_at(load, number);
    SamplingRules<3> rules = load.rules;
    if (load.is_polynomial)
      return sampler.sample(corners, density, rules, samples);
    const TriangleFeatures features(corners, density, load.spacing, load.largest);
    rules.part_size = [&](const mesh::PartCorners<3> &part, const Point<3> &, const Point<3> &) {
      return features.part_size(part);
    };
    return sampler.sample(corners, density, rules, samples);
  }

  std::array<Point<3>, 3>
  SurfaceLoads::corners_of(const unsigned int face) const
  {
    const auto &v = mesh.faces[face].vertices;
    return {{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]}};
  }

  double
  SurfaceLoads::sample(const unsigned int number, const unsigned int face, Samples &samples) const
  {
    const double error = sample_compactly(number, face, samples);
    sampler.expand(samples);
    return error;
  }

  double
  SurfaceLoads::sample_compactly(const unsigned int number,
                                 const unsigned int face,
                                 Samples           &samples) const
  {
    const Load        &load = *loads.at(number);
    const Tensor<1, 3> area = mesh::face_area_vector(mesh, mesh.faces[face]);
    const double       size = area.norm();
    if (is_constant(number))
      {
        const Tensor<1, 3> value = constant_traction(number, area / size);
        samples.assign(1, {{{1. / 3., 1. / 3., 1. / 3.}}, 1., value});
        return 0.;
      }
    const ResultantTraction *total = resultant(number);
    if (total != nullptr && total->uses_normal())
      return total->sample_bearing(mesh, face, surface(), sampler, samples);
    const Tensor<1, 3> normal = area / size;
    const auto density = [&](const Point<3> &x) { return traction(number, face, x, normal); };
    const auto corners = corners_of(face);
    if (total != nullptr)
      {
        sampler.sample_basic(corners, density, samples); // it is linear
        return 0.;
      }
    // The normal of a projected surface varies little in a face, and takes long to find.
    if (load.uses_normal && load.is_polynomial && surface().is_projected(face))
      return sampler.sample_basic(corners, density, samples);
    return sample_carefully(load, number, corners, density, samples);
  }

  double
  SurfaceLoads::sample_triangle(const unsigned int             number,
                                const std::array<Point<3>, 3> &corners,
                                const Tensor<1, 3>            &normal,
                                Samples                       &samples) const
  {
    if (const ResultantTraction *total = resultant(number))
      {
        sampler.sample_basic(
          corners, [&](const Point<3> &x) { return total->value(x, normal, normal); }, samples);
        return 0.;
      }
    const Load &load = *loads.at(number);
    return sample_carefully(
      load,
      number,
      corners,
      [&](const Point<3> &x) {
        const Tensor<1, 3> value = load.at(x, normal);
        return load.is_pressure ? -value[0] * normal : value;
      },
      samples);
  }

  void
  SurfaceLoads::check() const
  {
    for (const auto &load : loads)
      resultant(load.first);
  }

  const mesh::TrueSurface &
  SurfaceLoads::surface() const
  {
    if (true_surface == nullptr)
      true_surface = std::make_unique<mesh::TrueSurface>(mesh_parameters, mesh);
    return *true_surface;
  }

  std::string
  SurfaceLoads::remark(const unsigned int number) const
  {
    const Load &load = *loads.at(number);
    if (!load.is_looked_at || load.is_polynomial || load.spacing <= 1.0001 * load.wanted)
      return "";
    std::ostringstream text;
    text << load.name << ": the value is looked at with a spacing of " << load.spacing
         << " instead of " << load.wanted << ", as " << most_evaluations << " evaluations allow.";
    return text.str();
  }

  std::string
  SurfaceLoads::note(const unsigned int number) const
  {
    const ResultantTraction *total = resultant(number);
    return total != nullptr ? total->note() : "";
  }
} // namespace tetradapt::mechanics
