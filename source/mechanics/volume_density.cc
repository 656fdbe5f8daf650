// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/volume_density.h"

#include "tetradapt/core/polynomial_text.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace tetradapt::mechanics
{
  namespace
  {
    constexpr double default_spacing = 0.01; ///< of the body's diagonal
    /** Parts are not made smaller than this part of the grid's step. */
    constexpr double finest = 1. / 8.;
    /** Steps of the grid: where it has no mark, nothing in a part of this size is missed. */
    constexpr double seen_by_grid = 8.;
    /** Of the body's diagonal: steps that tell how large a polynomial is, and its smallest parts.
     */
    constexpr double few_points = 0.05, finest_of_polynomials = 0.02;
  } // namespace

  struct VolumeDensity::Term
  {
    Term(const std::array<std::string, 3> &texts,
         const std::string                &what,
         const std::map<int, double>      &factors,
         const double                      spacing)
      : what(what), factors(factors), expression(texts, what + "/Value"),
        constant(expression.is_constant()),
        polynomial(std::all_of(texts.begin(), texts.end(), core::is_polynomial)), spacing(spacing)
    {
      if (constant)
        constant_value = expression(Point<3>());
    }

    std::string                  what;
    std::map<int, double>        factors;
    core::VectorExpression       expression;
    bool                         constant, polynomial;
    Tensor<1, 3>                 constant_value;
    double                       spacing;           ///< wanted
    double                       longer_parts = 1.; ///< than the grid says
    std::unique_ptr<FeatureGrid> grid;
  };

  VolumeDensity::VolumeDensity(const std::pair<Point<3>, Point<3>> &body) : body(body)
  {
  }
  VolumeDensity::~VolumeDensity() = default;

  void
  VolumeDensity::add_term(const std::array<std::string, 3> &texts,
                          const std::string                &what,
                          const std::map<int, double>      &factors,
                          const double                      smallest_feature)
  {
    rules.reset();
    std::map<int, double> acting;
    std::copy_if(factors.begin(), factors.end(), std::inserter(acting, acting.end()), [](auto f) {
      return f.second != 0.;
    });
    const double standard = default_spacing * body.first.distance(body.second);
    terms.push_back(std::make_unique<Term>(texts,
                                           what,
                                           acting,
                                           smallest_feature > 0.
                                             ? std::min(smallest_feature, standard)
                                             : standard));
  }

  bool
  VolumeDensity::acts_in(const int region) const
  {
    return std::any_of(terms.begin(), terms.end(), [&](const auto &term) {
      return term->factors.count(region) != 0;
    });
  }

  bool
  VolumeDensity::is_constant(const int region) const
  {
    return std::none_of(terms.begin(), terms.end(), [&](const auto &term) {
      return !term->constant && term->factors.count(region) != 0;
    });
  }

  Tensor<1, 3>
  VolumeDensity::value(const int region, const Point<3> &point) const
  {
    Tensor<1, 3> sum;
    for (const auto &term : terms)
      {
        const auto factor = term->factors.find(region);
        if (factor != term->factors.end())
          sum += factor->second * (term->constant ? term->constant_value : term->expression(point));
      }
    return sum;
  }

  void
  VolumeDensity::look_at(const mesh::TetMesh &mesh) const
  {
    if (rules != nullptr)
      return;
    rules                 = std::make_unique<SamplingRules<4>>();
    rules->finest         = std::numeric_limits<double>::infinity();
    const double diagonal = body.first.distance(body.second);
    bool         has_grid = false;
    for (const auto &term : terms)
      {
        double largest = 0.;
        for (const auto &[region, factor] : term->factors)
          largest = std::max(largest, std::abs(factor));
        if (term->constant)
          {
            rules->mean += largest * term->constant_value.norm();
            continue;
          }
        const auto function = [&term](const Point<3> &x) { return term->expression(x); };
        const auto cells    = [&](const auto &action) {
          for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
            if (term->factors.count(mesh.regions[cell]) != 0)
              {
                const auto &v = mesh.cells[cell];
                action(
                  {{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]}});
              }
        };
        if (term->polynomial)
          {
            // A few points tell how large it is, and it has no small features.
            const FeatureGrid few(
              function, body.first, body.second, few_points * diagonal, most_nodes, cells);
            rules->mean += largest * few.mean();
            rules->finest = std::min(rules->finest, finest_of_polynomials * diagonal);
            continue;
          }
        term->grid = std::make_unique<FeatureGrid>(
          function, body.first, body.second, term->spacing, most_nodes, cells);
        has_grid           = true;
        rules->without_rim = std::min(rules->without_rim, seen_by_grid * term->grid->step());
        rules->mean += largest * term->grid->mean();
        // Six parts a box with 14 points each, if parts are as long as the grid's step.
        const double n     = 84. * term->grid->n_marks();
        const double finer = n > 0. ? std::cbrt(most_evaluations / n) : 1. / finest;
        rules->finest
          = std::min(rules->finest, term->grid->step() / std::clamp(finer, 0.1, 1. / finest));
        // Where it varies fast nearly everywhere parts cannot be as small as they should.
        term->longer_parts = std::max(1., 0.5 / finer);
      }
    if (has_grid)
      rules->part_size
        = [this](const mesh::PartCorners<4> &, const Point<3> &lower, const Point<3> &upper) {
            double size = std::numeric_limits<double>::infinity();
            for (const auto &term : terms)
              if (term->grid != nullptr)
                size = std::min(size, term->longer_parts * term->grid->part_size(lower, upper));
            return size;
          };
  }

  double
  VolumeDensity::sample(const mesh::TetMesh &mesh, const unsigned int cell, Samples &samples) const
  {
    const double error = sample_compactly(mesh, cell, samples);
    sampler.expand(samples);
    return error;
  }

  double
  VolumeDensity::sample_compactly(const mesh::TetMesh &mesh,
                                  const unsigned int   cell,
                                  Samples             &samples) const
  {
    const int region = mesh.regions[cell];
    if (is_constant(region))
      {
        samples.assign(1, {{{.25, .25, .25, .25}}, 1., value(region, Point<3>())});
        return 0.;
      }
    look_at(mesh);
    std::array<Point<3>, 4> corners;
    for (unsigned int i = 0; i < 4; ++i)
      corners[i] = mesh.points[mesh.cells[cell][i]];
    return sample(region, corners, samples);
  }

  double
  VolumeDensity::sample(const int                      region,
                        const std::array<Point<3>, 4> &corners,
                        Samples                       &samples) const
  {
    if (is_constant(region))
      {
        samples.assign(1, {{{.25, .25, .25, .25}}, 1., value(region, Point<3>())});
        sampler.expand(samples);
        return 0.;
      }
    if (rules == nullptr)
      throw std::logic_error("a density is sampled before it has been looked at");
    return sampler.sample(
      corners, [&](const Point<3> &x) { return value(region, x); }, *rules, samples);
  }

  std::string
  VolumeDensity::remark() const
  {
    std::ostringstream text;
    for (const auto &term : terms)
      if (term->grid != nullptr && term->grid->step() > 1.0001 * term->spacing)
        text << (text.tellp() > 0 ? " " : "") << term->what
             << ": the value is looked at with a spacing of " << term->grid->step()
             << " instead of " << term->spacing << ", as " << most_nodes << " points allow.";
    return text.str();
  }
} // namespace tetradapt::mechanics
