// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_spring_matrix_h
#define tetradapt_mechanics_spring_matrix_h

#include "tetradapt/fem/space.h"
#include "tetradapt/mechanics/springs.h"

#include <functional>

namespace tetradapt::mechanics
{
  /** The scalar functions of a space that are not zero on a face. */
  struct FaceFunctions
  {
    static constexpr unsigned int most = 10; ///< of degree 3

    unsigned int n_per_face = 0;
    /** Writes the numbers of those on a boundary face. */
    std::function<void(unsigned int face, unsigned int *numbers)> numbers;
    /** Their values at a point of it. */
    std::function<void(unsigned int face, const std::array<double, 3> &b, double *values)> values;
  };

  /**
   * The matrix int phi_i K phi_j of springs: 3x3 blocks, and rows for the functions on their faces
   * only. It adds to the stiffness of the body.
   */
  template <typename Number>
  class SpringMatrix
  {
  public:
    using Block = std::array<Number, 9>; ///< row by row

    /** Rows of the functions whose numbers are below @p n_rows: complete if all faces around them
     * are among those of @p springs. Keeps no reference. */
    SpringMatrix(const Springs &springs, const FaceFunctions &functions, unsigned int n_rows);

    /** The same matrix times @p scale. */
    SpringMatrix(const SpringMatrix<double> &other, double scale);

    /** y += A x for rows from @p begin to @p end of rows(); x and y have three components a
     * function. */
    void
    add_product(const Number *x, Number *y, std::size_t begin, std::size_t end) const;
    void
    add_product(const Number *x, Number *y) const
    {
      add_product(x, y, 0, row_numbers.size());
    }

    /** The functions that have a row, ascending. */
    const std::vector<unsigned int> &
    rows() const
    {
      return row_numbers;
    }
    /** Where the entries of the row rows()[k] begin; they end with those of the next. */
    std::size_t
    row_begin(const std::size_t k) const
    {
      return begins[k];
    }
    unsigned int
    column(const std::size_t entry) const
    {
      return columns[entry];
    }
    const Block &
    block(const std::size_t entry) const
    {
      return blocks[entry];
    }
    /** The block of the row rows()[k] on the diagonal. */
    const Block &
    diagonal(const std::size_t k) const
    {
      return blocks[begins[k]];
    }

  private:
    template <typename>
    friend class SpringMatrix;

    std::vector<unsigned int> row_numbers;
    std::vector<std::size_t>  begins{0};
    std::vector<unsigned int> columns; ///< that of the diagonal first
    std::vector<Block>        blocks;
  };

  /** The matrix on the nodes of @p space: rows of the owned nodes, columns in local numbers. No
   * communication. */
  SpringMatrix<double>
  make_spring_matrix(const Springs &springs, const fem::Space &space);

  extern template class SpringMatrix<double>;
  extern template class SpringMatrix<float>;
} // namespace tetradapt::mechanics

#endif
