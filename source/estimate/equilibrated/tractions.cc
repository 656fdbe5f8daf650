// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tractions.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/finalize.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    constexpr unsigned int none = StarFlow::outside;

    /** On each face of a cell, the face's function that is the cell's function n, or
     * none where that vanishes. */
    constexpr unsigned int face_function[4][10] = {{none, 0, 1, 2, none, 3, none, none, 5, 4},
                                                   {0, none, 2, 1, none, none, 5, 3, none, 4},
                                                   {0, 1, none, 2, 3, none, none, 5, 4, none},
                                                   {0, 2, 1, none, 5, 4, 3, none, none, none}};
  } // namespace

  FaceTractions::FaceTractions(const mesh::NodalField      &u_h,
                               const CellStates            &states,
                               const CellFaces             &faces,
                               const std::vector<FaceLoad> &loads,
                               const compare::Slice        &own)
    : moments(18 * std::size_t(faces.n_faces), 0.), u_h(u_h), mesh(u_h.mesh()), faces(faces),
      loads(loads), n_functions(u_h.n_nodes_per_cell()), first_cell(faces.n_faces, none)
  {
    find_cells(own);
    set_targets(states);
    set_given_tractions();
    balance(false);
    if (n_functions == 10)
      balance(true);
    change_functions();
  }

  void
  FaceTractions::find_cells(const compare::Slice &own)
  {
    wanted_points.assign(mesh.n_points(), 0);
    wanted_cells.assign(mesh.n_cells(), 0);
    for (unsigned int cell = own.begin; cell < own.end; ++cell)
      for (const unsigned int point : mesh.cells[cell])
        wanted_points[point] = 1;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (const unsigned int point : mesh.cells[cell])
        wanted_cells[cell] |= wanted_points[point];
  }

  void
  FaceTractions::set_targets(const CellStates &states)
  {
    unbalanced.resize(std::size_t(n_functions) * mesh.n_cells());
    conductance.assign(faces.n_faces, 0.); // here: sums of weights
    CellState    state;
    Tensor<1, 3> m[6];
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      {
        if (wanted_cells[cell] == 0)
          continue;
        states.compute(cell, state);
        Tensor<1, 3> *rest = &unbalanced[std::size_t(n_functions) * cell];
        unbalanced_moments(state, n_functions, rest);
        for (unsigned int n = 0; n < n_functions; ++n)
          largest_unbalanced = std::max(largest_unbalanced, rest[n].norm_square());
        for (unsigned int f = 0; f < 4; ++f)
          {
            // What a moment costs: compliance times height over area.
            const auto  &side = faces.sides[cell][f];
            const double weight
              = states.tension_compliance(cell) / (state.volume * state.gradients[f].norm_square());
            const double factor = side.second ? -weight : weight;
            conductance[side.face] += weight;
            traction_moments(state, f, m);
            double *sum = &moments[18 * std::size_t(side.face)];
            for (unsigned int s = 0; s < 6; ++s)
              for (unsigned int c = 0; c < 3; ++c)
                sum[3 * side.function(s) + c] += factor * m[s][c];
          }
      }
    largest_unbalanced = std::sqrt(largest_unbalanced);
    for (unsigned int face = 0; face < faces.n_faces; ++face)
      if (conductance[face] > 0.)
        {
          conductance[face] = 1. / conductance[face];
          for (unsigned int i = 0; i < 18; ++i)
            moments[18 * std::size_t(face) + i] *= conductance[face];
        }
  }

  void
  FaceTractions::set_given_tractions()
  {
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (unsigned int f = 0; f < 4; ++f)
        {
          const auto        &side  = faces.sides[cell][f];
          const unsigned int which = faces.boundary[side.face];
          if (which == none)
            continue;
          // The listed face begins with another corner, at most.
          const auto  &listed = mesh.faces[which].vertices;
          unsigned int turn   = 0;
          while (turn < 2 && listed[turn] != mesh.cells[cell][mesh::face_vertices[f][0]])
            ++turn;
          for (unsigned int s = 0; s < 6; ++s)
            for (unsigned int c = 0; c < 3; ++c)
              if ((loads[which].held >> c & 1) == 0)
                moments[18 * std::size_t(side.face) + 3 * side.function(s) + c]
                  = loads[which].moments[s < 3 ? (s + turn) % 3 : 3 + (s + turn) % 3][c];
        }
  }

  void
  FaceTractions::balance(const bool edges)
  {
    // The cells around each vertex or edge, as 16 * cell + function.
    const unsigned int n = edges ? 6 : 4, first = edges ? 4 : 0;
    const auto         number = [&](unsigned int cell, unsigned int i) {
      return edges ? u_h.edges().cell_edges[cell][i] : mesh.cells[cell][i];
    };
    const auto wanted = [&](unsigned int star) {
      if (!edges)
        return wanted_points[star] != 0;
      const auto &ends = u_h.edges().edges[star];
      return wanted_points[ends[0]] != 0 && wanted_points[ends[1]] != 0;
    };
    const unsigned int        n_stars = edges ? u_h.edges().edges.size() : mesh.n_points();
    std::vector<unsigned int> begin(n_stars + 1, 0), cells(std::size_t(n) * mesh.n_cells());
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (unsigned int i = 0; i < n; ++i)
        ++begin[number(cell, i)];
    for (unsigned int star = 0, sum = 0; star <= n_stars; ++star)
      {
        sum += begin[star];
        begin[star] = sum;
      }
    for (unsigned int cell = mesh.n_cells(); cell-- > 0;)
      for (unsigned int i = 0; i < n; ++i)
        cells[--begin[number(cell, i)]] = 16 * cell + first + i;
    for (unsigned int star = 0; star < n_stars; ++star)
      if (wanted(star))
        balance_star(cells.data() + begin[star], cells.data() + begin[star + 1]);
  }

  Point<3>
  FaceTractions::center_of(const unsigned int entry) const
  {
    const auto        &corners  = mesh.cells[entry / 16];
    const unsigned int function = entry % 16;
    if (function < 4)
      return mesh.points[corners[function]];
    const auto    &edge = mesh::edge_vertices[function - 4];
    const Point<3> from = mesh.points[corners[edge[0]]];
    return from + .5 * (mesh.points[corners[edge[1]]] - from);
  }

  void
  FaceTractions::connect_star(const unsigned int *begin,
                              const unsigned int *end,
                              const unsigned int  component)
  {
    flow.begin(end - begin);
    ways.clear();
    for (unsigned int a = 0; begin + a != end; ++a)
      {
        const unsigned int cell = begin[a] / 16, function = begin[a] % 16;
        Tensor<1, 3>       supply = unbalanced[std::size_t(n_functions) * cell + function];
        for (unsigned int f = 0; f < 4; ++f)
          {
            if (face_function[f][function] == none)
              continue;
            const auto        &side = faces.sides[cell][f];
            const unsigned int face = side.face, which = faces.boundary[face];
            const unsigned int at   = side.function(face_function[f][function]);
            const double       sign = side.second ? -1. : 1.;
            for (unsigned int c = 0; c < 3; ++c)
              supply[c] -= sign * moments[18 * std::size_t(face) + 3 * at + c];
            if (which == none && first_cell[face] == none)
              {
                first_cell[face] = a;
                continue;
              }
            if (which != none && (loads[which].held >> component & 1) == 0)
              continue;
            flow.add_way(a,
                         which == none ? first_cell[face] : StarFlow::outside,
                         conductance[face]);
            ways.push_back({face, at, sign});
            first_cell[face] = none;
          }
        for (unsigned int c = 0; c < 3; ++c)
          flow.supply()[3 * a + c] = supply[c];
      }
  }

  void
  FaceTractions::balance_star(const unsigned int *begin, const unsigned int *end)
  {
    // Supports may hold some of the components only: then each has ways of its own.
    unsigned char all = 7;
    for (const unsigned int *entry = begin; entry != end; ++entry)
      for (unsigned int f = 0; f < 4; ++f)
        if (face_function[f][*entry % 16] != none)
          {
            const unsigned int which = faces.boundary[faces.sides[*entry / 16][f].face];
            if (which != none && loads[which].held != 0)
              all &= loads[which].held;
          }
    const unsigned int step = all == 7 ? 3 : 1;
    for (unsigned int c = 0; c < 3; c += step)
      {
        connect_star(begin, end, c);
        if (flow.solve(c, c + step) > 1e-6 * largest_unbalanced)
          throw core::InputError(
            "Mesh: at " + mesh::to_string(center_of(*begin))
            + " parts of the body touch in a point or along an edge only, and a force passes "
              "there, which no stress can carry: the error has no bound by an equilibrated "
              "stress. Join or separate the parts there, or choose another error estimator.");
        for (unsigned int way = 0; way < ways.size(); ++way)
          for (unsigned int d = c; d < c + step; ++d)
            moments[18 * std::size_t(ways[way].face) + 3 * ways[way].function + d]
              += ways[way].sign * flow.flow(way, d);
      }
  }

  void
  FaceTractions::change_functions()
  {
    for (unsigned int face = 0; face < faces.n_faces; ++face)
      {
        double             *m     = &moments[18 * std::size_t(face)];
        const unsigned int  which = faces.boundary[face];
        const unsigned char held  = which == none ? 7 : loads[which].held;
        for (unsigned int c = 0; c < 3; ++c)
          {
            double component[6];
            for (unsigned int s = 0; s < 6; ++s)
              component[s] = m[3 * s + c];
            make_orthogonal(component);
            // Only degree 2 has functions that tell the last three.
            for (unsigned int s = 3; s < 6; ++s)
              m[3 * s + c] = n_functions == 4 && (held >> c & 1) != 0 ? 0. : component[s];
          }
      }
  }
} // namespace tetradapt::estimate
