// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/resultant_traction.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/surface_expression.h"

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tetradapt::mechanics
{
  namespace
  {
    /** Smallest over largest second moment of area of faces that carry any moment. */
    constexpr double narrow = 1e-10;
    /** Mean square of the cosine between a force and the normal of faces that it presses on. */
    constexpr double parallel = 1e-12;
    /** Of the force: more across it is told. */
    constexpr double noticeable = 0.01;
    constexpr double rounding   = 1e-14;
    /** Of the mean of max(0, -n . d) on a face, and the smallest part of its size that it is
     * cut into for that. */
    constexpr double accuracy = 1e-5, finest = 1. / 16.;

    Tensor<1, 3>
    constants(const std::array<std::string, 3> &texts, const std::string &what)
    {
      return core::SurfaceExpression(texts, what)(Point<3>(), Tensor<1, 3>());
    }

    /** Area, centroid and second moments about it. */
    struct Area
    {
      Area(const mesh::TetMesh &mesh, const std::vector<unsigned int> &faces)
      {
        // In two steps, as differences of large numbers would lose digits.
        Tensor<1, 3> first;
        const auto   start
          = faces.empty() ? Point<3>() : mesh.points[mesh.faces[faces[0]].vertices[0]];
        for (const unsigned int f : faces)
          {
            const double part = mesh::face_area_vector(mesh, mesh.faces[f]).norm();
            size += part;
            for (const unsigned int v : mesh.faces[f].vertices)
              first += part / 3. * (mesh.points[v] - start);
          }
        centroid = start + (size > 0. ? first / size : first);
        for (const unsigned int f : faces)
          {
            const double part = mesh::face_area_vector(mesh, mesh.faces[f]).norm();
            // int l_i l_j = (1 + [i = j]) A / 12
            Tensor<1, 3>                  sum;
            dealii::SymmetricTensor<2, 3> squares;
            for (const unsigned int v : mesh.faces[f].vertices)
              {
                const Tensor<1, 3> r = mesh.points[v] - centroid;
                sum += r;
                squares += symmetrize(outer_product(r, r));
              }
            squares += symmetrize(outer_product(sum, sum));
            squares *= part / 12.;
            moments += trace(squares) * dealii::unit_symmetric_tensor<3>() - squares;
          }
      }

      double                        size = 0.;
      Point<3>                      centroid;
      dealii::SymmetricTensor<2, 3> moments;
    };

    std::string
    text_of(const Point<3> &point)
    {
      std::ostringstream text;
      text.precision(5);
      text << point[0] << ", " << point[1] << ", " << point[2];
      return text.str();
    }
  } // namespace

  ResultantTraction
  ResultantTraction::even(const scene::LoadParameters     &load,
                          const mesh::TetMesh             &mesh,
                          const std::vector<unsigned int> &faces)
  {
    const std::string  path = "Loads/" + load.name;
    const Area         area(mesh, faces);
    const Tensor<1, 3> force  = constants(load.value, path + "/Value");
    const Tensor<1, 3> moment = constants(load.total.moment, path + "/Moment");
    ResultantTraction  result;
    if (area.size == 0.)
      return result;
    result.centroid    = area.centroid;
    result.constant    = force / area.size;
    const Point<3> p   = load.total.about.value_or(area.centroid);
    const auto     own = moment + cross_product_3d(p - area.centroid, force);
    if (own.norm()
        <= rounding
             * (moment.norm() + (p.norm() + Tensor<1, 3>(area.centroid).norm()) * force.norm()))
      return result;
    const auto principal = eigenvalues(area.moments); // the largest first
    if (!(principal[2] > narrow * principal[0]))
      throw core::InputError(
        path + "/Moment: the selected faces, around " + text_of(area.centroid)
        + ", lie so near one line that no traction on them has a moment about it. Select more "
          "faces, or set About and Moment so that there is none about their centroid.");
    const auto inverse = invert(area.moments);
    result.rotation    = inverse * own;
    // What rounding left, of faces in a narrow strip.
    result.rotation += inverse * (own - area.moments * result.rotation);
    return result;
  }

  ResultantTraction
  ResultantTraction::bearing(const scene::LoadParameters     &load,
                             const mesh::TetMesh             &mesh,
                             const std::vector<unsigned int> &faces,
                             const mesh::TrueSurface         &surface,
                             const Sampler                   &sampler)
  {
    const std::string  path  = "Loads/" + load.name;
    const Tensor<1, 3> force = constants(load.value, path + "/Value");
    ResultantTraction  result;
    result.is_bearing = true;
    if (faces.empty())
      return result;
    result.direction        = force / force.norm();
    result.largest_pressure = 1.;
    double           area   = 0.;
    Tensor<1, 3>     unit;
    Sampler::Samples samples;
    for (const unsigned int f : faces)
      {
        const double part = mesh::face_area_vector(mesh, mesh.faces[f]).norm();
        area += part;
        result.sample_bearing(mesh, f, surface, sampler, samples);
        for (const auto &point : samples)
          unit += part * point.weight * point.value;
      }
    const double along = unit * result.direction;
    if (!(along > parallel * area))
      throw core::InputError(path
                             + "/Value: the force presses on none of the selected faces: it pulls "
                               "at them, or acts along them. Turn it round, select the faces that "
                               "it presses on, or use Distribution = even.");
    result.largest_pressure = force.norm() / along;
    result.constant         = (force - result.largest_pressure * unit) / area;
    const double across     = (force - result.largest_pressure * unit).norm() / force.norm();
    if (across > noticeable)
      {
        std::ostringstream text;
        text.precision(2);
        text << path << ": the faces that the force presses on are not symmetric about it, so that "
             << "the pressure also acts across it; an even traction of " << 100. * across
             << " % of the force removes that.";
        result.added = text.str();
      }
    return result;
  }

  Tensor<1, 3>
  ResultantTraction::value(const Point<3>     &point,
                           const Tensor<1, 3> &n,
                           const Tensor<1, 3> &m) const
  {
    return is_bearing ? constant + largest_pressure * shape(n, m)
                      : constant + cross_product_3d(rotation, point - centroid);
  }

  Tensor<1, 3>
  ResultantTraction::shape(const Tensor<1, 3> &n, const Tensor<1, 3> &m) const
  {
    return -std::max(0., -(n * direction)) * m;
  }

  double
  ResultantTraction::sample_bearing(const mesh::TetMesh     &mesh,
                                    const unsigned int       face,
                                    const mesh::TrueSurface &surface,
                                    const Sampler           &sampler,
                                    Sampler::Samples        &samples) const
  {
    const auto                   &v = mesh.faces[face].vertices;
    const std::array<Point<3>, 3> corners{
      {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]}};
    const Tensor<1, 3> area   = mesh::face_area_vector(mesh, mesh.faces[face]);
    const Tensor<1, 3> normal = area / area.norm();
    // The points must not depend on the constants: the shape alone is sampled.
    double error = 0.;
    if (surface.is_projected(face))
      {
        SamplingRules<3> rules;
        rules.mean      = 1.;
        rules.tolerance = accuracy;
        rules.finest    = finest * std::sqrt(area.norm());
        error           = sampler.sample(
          corners,
          [&](const Point<3> &x) { return shape(surface.at(face, x).normal, normal); },
          rules,
          samples);
      }
    else
      sampler.sample_basic(
        corners, [&](const Point<3> &) { return shape(normal, normal); }, samples);
    for (auto &point : samples)
      point.value = constant + largest_pressure * point.value;
    return largest_pressure * error;
  }
} // namespace tetradapt::mechanics
