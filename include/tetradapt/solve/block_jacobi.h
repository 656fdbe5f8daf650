// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_block_jacobi_h
#define tetradapt_solve_block_jacobi_h

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <vector>

namespace tetradapt::solve
{
  /** The inverses of the diagonal blocks, n x n, one a node and row by row. A block that
   * cannot be inverted, or whose inverse is not positive, is taken for its diagonal. */
  template <typename Number, unsigned int n>
  std::vector<std::array<Number, n * n>>
  invert_blocks(const std::vector<std::array<Number, n * n>> &blocks);

  /** What a step of a smoother does to its vectors, in BlockJacobi::step(). */
  struct JacobiStep
  {
    double keep;   ///< of the direction before
    double factor; ///< of D^-1 r
    bool   is_last = false;
  };

  /**
   * The inverses of the diagonal blocks of a matrix, and the loops of a smoother that go over
   * its vectors: each reads and writes every vector once. All pointers are to the values of
   * the owned nodes, n a node.
   */
  template <typename Number, unsigned int n>
  class BlockJacobi
  {
  public:
    /** @param inverses as invert_blocks() makes them; zero rows keep an unknown at zero. */
    explicit BlockJacobi(const std::vector<std::array<Number, n * n>> &inverses);

    std::size_t
    n_nodes() const
    {
      return node_count;
    }

    /** x = d = factor D^-1 b. */
    void
    start(double factor, const Number *b, Number *d, Number *x) const;

    /** r = from - product; d = keep d + factor D^-1 r; x += d. @p from may be @p r. After the
     * last step r and d are of no use. */
    void
    step(const JacobiStep &step,
         const Number     *from,
         const Number     *product,
         Number           *r,
         Number           *d,
         Number           *x) const;

  private:
    std::size_t node_count;
    /** Of 3 x 3 blocks the upper triangles, as many at a time as a cache line holds numbers:
     * entry k of block l of such a batch is number k * lanes + l. Else whole blocks. */
    dealii::AlignedVector<Number> entries;
  };
} // namespace tetradapt::solve

#endif
