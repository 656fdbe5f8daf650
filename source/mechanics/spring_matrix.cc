// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/spring_matrix.h"

#include "tetradapt/mechanics/supports.h"

#include <algorithm>
#include <type_traits>

namespace tetradapt::mechanics
{
  namespace
  {
    /** A function on one of the faces of springs. */
    struct Place
    {
      unsigned int row;   ///< its number
      unsigned int face;  ///< index into Springs::faces()
      unsigned int which; ///< of the functions on it
    };
  } // namespace

  template <typename Number>
  SpringMatrix<Number>::SpringMatrix(const Springs       &springs,
                                     const FaceFunctions &functions,
                                     const unsigned int   n_rows)
  {
    const unsigned int                                         n = functions.n_per_face;
    std::vector<std::array<unsigned int, FaceFunctions::most>> numbers(springs.faces().size());
    std::vector<Place>                                         places;
    for (unsigned int k = 0; k < numbers.size(); ++k)
      {
        functions.numbers(springs.faces()[k].face, numbers[k].data());
        for (unsigned int i = 0; i < n; ++i)
          if (numbers[k][i] < n_rows)
            places.push_back({numbers[k][i], k, i});
      }
    std::stable_sort(places.begin(), places.end(), [](const Place &a, const Place &b) {
      return a.row < b.row;
    });
    double N[FaceFunctions::most];
    for (auto place = places.cbegin(); place != places.cend();)
      {
        const unsigned int row   = place->row;
        const std::size_t  first = columns.size();
        row_numbers.push_back(row);
        columns.push_back(row);
        blocks.push_back(Block{});
        for (; place != places.cend() && place->row == row; ++place)
          {
            std::size_t entries[FaceFunctions::most];
            for (unsigned int j = 0; j < n; ++j)
              {
                const unsigned int column = numbers[place->face][j];
                entries[j]
                  = std::find(columns.begin() + first, columns.end(), column) - columns.begin();
                if (entries[j] == columns.size())
                  {
                    columns.push_back(column);
                    blocks.push_back(Block{});
                  }
              }
            const Springs::Face &face = springs.faces()[place->face];
            for (const Springs::Sample &point : face.points)
              {
                functions.values(face.face, point.b, N);
                for (unsigned int j = 0; j < n; ++j)
                  {
                    const double factor = point.weight * N[place->which] * N[j];
                    Block       &block  = blocks[entries[j]];
                    for (unsigned int c = 0; c < 9; ++c)
                      block[c] += factor * point.stiffness[c / 3][c % 3];
                  }
              }
          }
        begins.push_back(columns.size());
      }
  }

  template <typename Number>
  SpringMatrix<Number>::SpringMatrix(const SpringMatrix<double> &other, const double scale)
    : row_numbers(other.row_numbers), begins(other.begins), columns(other.columns),
      blocks(other.blocks.size())
  {
    for (std::size_t k = 0; k < blocks.size(); ++k)
      for (unsigned int c = 0; c < 9; ++c)
        blocks[k][c] = static_cast<Number>(scale * other.blocks[k][c]);
  }

  template <typename Number>
  void
  SpringMatrix<Number>::add_product(const Number     *x,
                                    Number           *y,
                                    const std::size_t begin,
                                    const std::size_t end) const
  {
    for (std::size_t row = begin; row < end; ++row)
      {
        Number y0 = 0, y1 = 0, y2 = 0;
        for (std::size_t k = begins[row]; k < begins[row + 1]; ++k)
          {
            const Block        &b = blocks[k];
            const Number *const v = x + 3 * static_cast<std::size_t>(columns[k]);
            y0 += b[0] * v[0] + b[1] * v[1] + b[2] * v[2];
            y1 += b[3] * v[0] + b[4] * v[1] + b[5] * v[2];
            y2 += b[6] * v[0] + b[7] * v[1] + b[8] * v[2];
          }
        Number *const to = y + 3 * static_cast<std::size_t>(row_numbers[row]);
        to[0] += y0;
        to[1] += y1;
        to[2] += y2;
      }
  }

  SpringMatrix<double>
  make_spring_matrix(const Springs &springs, const fem::Space &space)
  {
    const auto    nodes = boundary_face_nodes(space.tet_mesh(), space.edge_table());
    FaceFunctions functions;
    functions.n_per_face = space.degree() == 1 ? 3 : 6;
    functions.numbers    = [&](const unsigned int face, unsigned int *numbers) {
      for (unsigned int i = 0; i < functions.n_per_face; ++i)
        numbers[i] = space.local_node(nodes[face][i]);
    };
    functions.values = [&](const unsigned int, const std::array<double, 3> &b, double *values) {
      face_shape_values(space.degree(), b, values);
    };
    return SpringMatrix<double>(springs, functions, space.n_owned_nodes());
  }

  template class SpringMatrix<double>;
  template class SpringMatrix<float>;
} // namespace tetradapt::mechanics
