// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_star_h
#define tetradapt_estimate_equilibrated_star_h

#include <cstddef>
#include <limits>
#include <vector>

namespace tetradapt::estimate
{
  /**
   * Flows on the faces between the cells of a star (those around a vertex or an
   * edge), such that what flows out of every cell is what it has to give, and
   * that sum flow^2 / conductance is smallest. The flow on face F from cell a to
   * cell b is conductance (potential_a - potential_b); the potentials solve a
   * graph's Laplace equation, by Cholesky's decomposition in a breadth-first
   * order, which keeps the matrix in a narrow envelope. For the three components of
   * a force at once. Memory is kept from star to star.
   */
  class StarFlow
  {
  public:
    static constexpr unsigned int outside = std::numeric_limits<unsigned int>::max();

    /** Begins a star of @p n_cells cells. */
    void
    begin(unsigned int n_cells);

    /** Adds a way from cell @p a to cell @p b, or to the outside, which takes
     * whatever flows there. Ways are numbered in the order in which they come. */
    void
    add_way(unsigned int a, unsigned int b, double conductance);

    /** What each cell has to give: component c of cell a is supply()[3 a + c]. */
    std::vector<double> &
    supply()
    {
      return right;
    }

    /**
     * Computes the flows of the components from @p first to before @p last. What
     * the cells of a connected part without a way out have to give must sum to
     * zero; what it sums to is shared among them.
     * @return the largest such sum if there are several parts without a way out,
     *         else 0: then the sum is what Galerkin's method makes zero.
     */
    double
    solve(unsigned int first, unsigned int last);

    /** Component @p c of the flow through way @p way. */
    double
    flow(unsigned int way, unsigned int c) const
    {
      const Way &w = ways[way];
      return w.conductance * (right[3 * w.a + c] - (w.b == outside ? 0. : right[3 * w.b + c]));
    }

  private:
    struct Way
    {
      unsigned int a, b;
      double       conductance;
    };

    void
    order_cells();
    void
    factorise();

    unsigned int                n = 0;
    std::vector<Way>            ways;
    std::vector<double>         right;  ///< supplies, then potentials
    std::vector<unsigned int>   begins; ///< of each cell in neighbors
    std::vector<unsigned int>   neighbors;
    std::vector<unsigned int>   order, place; ///< cells breadth first, and back
    std::vector<unsigned int>   parts;        ///< where the connected parts begin in order
    std::vector<char>           has_way_out;  ///< a part each
    std::vector<unsigned int>   first_column; ///< of each row of the envelope
    std::vector<std::ptrdiff_t> row_begin;    ///< row i's column j is at row_begin[i] + j
    std::vector<double>         matrix, ordered;
  };
} // namespace tetradapt::estimate

#endif
