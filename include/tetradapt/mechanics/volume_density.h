// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_volume_density_h
#define tetradapt_mechanics_volume_density_h

#include "tetradapt/core/expression.h"
#include "tetradapt/mechanics/density_sampler.h"
#include "tetradapt/mechanics/feature_grid.h"
#include "tetradapt/mesh/tet_mesh.h"

#include <map>
#include <memory>

namespace tetradapt::mechanics
{
  /**
   * A vector function of the position that acts in regions of a body: a sum of terms, each an
   * expression times a factor a region. A body force has one term, a weight also (its factors
   * are densities); the thermal strain of all temperatures has one for each, in the first
   * component (its factors are thermal expansions).
   *
   * An expression is looked at on a grid of its own, made when it is first needed, which does not
   * depend on the mesh. Cells are sampled accordingly (DensitySampler). One object is to be
   * used by one thread.
   */
  class VolumeDensity
  {
  public:
    using Samples = DensitySampler<4>::Samples;

    /** @param body the box around the body, for the grids. */
    explicit VolumeDensity(const std::pair<Point<3>, Point<3>> &body);
    VolumeDensity(const VolumeDensity &) = delete;
    VolumeDensity &
    operator=(const VolumeDensity &)
      = delete;
    ~VolumeDensity();

    /**
     * @param texts three expressions; @param what names the place in messages.
     * @param factors per region; the term does not act in others.
     * @param smallest_feature the spacing of the grid; 0, and at most: 1/100 of the box's diagonal.
     * @throws core::InputError if an expression does not compile.
     */
    void
    add_term(const std::array<std::string, 3> &texts,
             const std::string                &what,
             const std::map<int, double>      &factors,
             double                            smallest_feature);

    /** Whether a term acts in a region. */
    bool
    acts_in(int region) const;

    /** Whether it is the same at all points of a region. */
    bool
    is_constant(int region) const;

    /** The sum of the terms, with a region's factors. */
    Tensor<1, 3>
    value(int region, const Point<3> &point) const;

    /**
     * Replaces @p samples by points of a cell with weights that sum to one and the values there,
     * for integrals of it times polynomials of degree up to 5.
     * @return an estimate of the remaining error of the mean value in the cell.
     */
    double
    sample(const mesh::TetMesh &mesh, unsigned int cell, Samples &samples) const;

    /** Looks at the expressions, where they act on @p mesh; once. sample() does it if need be, on
     * the mesh that it is given. */
    void
    look_at(const mesh::TetMesh &mesh) const;

    /** The same for any tetrahedron in a region, after look_at(). */
    double
    sample(int region, const std::array<Point<3>, 4> &corners, Samples &samples) const;

    /** The same, but in regions where it is constant there is one point, the centroid. */
    double
    sample_compactly(const mesh::TetMesh &mesh, unsigned int cell, Samples &samples) const;

    /** Empty, or how the spacing differs from the one that was asked for. */
    std::string
    remark() const;

    /** Evaluations on one mesh that are spent on parts of cells where an expression varies
     * fast, up to a factor of about ten; they set the size of the smallest parts. */
    static constexpr double most_evaluations = 2e5;
    /** Nodes of a grid. */
    static constexpr std::size_t most_nodes = 4000000;

  private:
    struct Term;

    std::pair<Point<3>, Point<3>>             body;
    std::vector<std::unique_ptr<Term>>        terms;
    DensitySampler<4>                         sampler;
    mutable std::unique_ptr<SamplingRules<4>> rules; ///< made when they are first needed
  };
} // namespace tetradapt::mechanics

#endif
