// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_simplex_parts_h
#define tetradapt_mesh_simplex_parts_h

#include <array>

/** Parts of a triangle or a tetrahedron, for quadrature. */
namespace tetradapt::mesh
{
  /** The corners of a part, each by its barycentric coordinates in the whole. @tparam n_corners
   * 3 or 4, @tparam n_coordinates of the whole: 4 for a face that is seen from a cell. */
  template <unsigned int n_corners, unsigned int n_coordinates = n_corners>
  using PartCorners = std::array<std::array<double, n_coordinates>, n_corners>;

  /** The point of a part with the barycentric coordinates @p weights in it. */
  template <unsigned int n_corners, unsigned int n_coordinates>
  std::array<double, n_coordinates>
  point_in_part(const std::array<std::array<double, n_coordinates>, n_corners> &corners,
                const std::array<double, n_corners>                            &weights)
  {
    std::array<double, n_coordinates> b{};
    for (unsigned int k = 0; k < n_corners; ++k)
      for (unsigned int i = 0; i < n_coordinates; ++i)
        b[i] += weights[k] * corners[k][i];
    return b;
  }

  template <unsigned long n_coordinates>
  std::array<double, n_coordinates>
  middle_of(const std::array<double, n_coordinates> &a, const std::array<double, n_coordinates> &b)
  {
    std::array<double, n_coordinates> result;
    for (unsigned int i = 0; i < n_coordinates; ++i)
      result[i] = 0.5 * (a[i] + b[i]);
    return result;
  }

  /** Calls @p action with the corners of the 4 or 8 parts of the same measure that middles of
   * edges make of a part. Parts of parts keep their shapes: with the order of the corners here,
   * tetrahedra have three at most (Bey, Computing 55, 1995). */
  template <unsigned long n_corners, unsigned long n_coordinates, typename Action>
  void
  for_children(const std::array<std::array<double, n_coordinates>, n_corners> &c,
               const Action                                                   &action)
  {
    static_assert(n_corners == 3 || n_corners == 4, "triangles and tetrahedra");
    using Corners = std::array<std::array<double, n_coordinates>, n_corners>;
    // One part at each corner, and the rest: a triangle, or four tetrahedra around the
    // diagonal of an octahedron from edge (0,2) to edge (1,3).
    for (unsigned int i = 0; i < n_corners; ++i)
      {
        Corners child = c;
        for (unsigned int j = 0; j < n_corners; ++j)
          child[j] = middle_of(c[i], c[j]);
        action(child);
      }
    const auto m = [&c](unsigned int i, unsigned int j) { return middle_of(c[i], c[j]); };
    if constexpr (n_corners == 3)
      action(Corners{{m(0, 1), m(1, 2), m(2, 0)}});
    else
      {
        const auto a = m(0, 1), b = m(0, 2), c03 = m(0, 3), d = m(1, 2), e = m(1, 3), f = m(2, 3);
        action(Corners{{a, b, c03, e}});
        action(Corners{{a, b, d, e}});
        action(Corners{{b, c03, e, f}});
        action(Corners{{b, d, e, f}});
      }
  }
} // namespace tetradapt::mesh

#endif
