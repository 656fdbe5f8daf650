// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/residual.h"

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/compare/root_of_squares.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/estimate/cell_stress.h"
#include "tetradapt/estimate/given_loads.h"
#include "tetradapt/estimate/stress_difference.h"
#include "tetradapt/mesh/face_table.h"

namespace tetradapt::estimate
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    /** The force per area of a stress on a plane. */
    Tensor<1, 3>
    traction(const double *stress, const Tensor<1, 3> &normal)
    {
      Tensor<1, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[i] += stress[stress_index[i][j]] * normal[j];
      return result;
    }

    /** Adds factor * C_ijkl n_j n_l, the traction that a jump a of the gradient's normal
     * derivative causes. */
    void
    add_acoustic_tensor(const double           factor,
                        const ElasticMatrices &matrices,
                        const Tensor<1, 3>    &n,
                        double (&result)[3][3])
    {
      // Column k of N is the strain of a (x) n for the unit vector a = e_k.
      for (unsigned int k = 0; k < 3; ++k)
        {
          double column[6];
          for (unsigned int a = 0; a < 6; ++a)
            {
              column[a] = 0.;
              for (unsigned int l = 0; l < 3; ++l)
                column[a] += matrices.stiffness[a][stress_index[k][l]] * n[l];
            }
          const Tensor<1, 3> t = traction(column, n);
          for (unsigned int i = 0; i < 3; ++i)
            result[i][k] += factor * t[i];
        }
    }

    /** v . A^-1 v for a symmetric positive A. */
    class InverseNorm
    {
    public:
      explicit InverseNorm(const double (&A)[3][3])
      {
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
              const unsigned int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
              cofactors[i][j] = A[i1][j1] * A[i2][j2] - A[i1][j2] * A[i2][j1];
            }
        determinant
          = A[0][0] * cofactors[0][0] + A[0][1] * cofactors[0][1] + A[0][2] * cofactors[0][2];
      }

      double
      square(const Tensor<1, 3> &v) const
      {
        double sum = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            sum += v[i] * cofactors[i][j] * v[j];
        return sum / determinant;
      }

    private:
      double cofactors[3][3], determinant;
    };

    /** The squared indicators, term by term. */
    class ResidualTerms
    {
    public:
      ResidualTerms(const mesh::NodalField &u_h, const CellStress &stress, const GivenLoads &loads)
        : mesh(u_h.mesh()), degree(u_h.degree()), stress(stress), loads(loads),
          constant(1. / (24. * u_h.degree())), squares(u_h.mesh().n_cells(), 0.),
          volumes(u_h.mesh().n_cells())
      {
        for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
          volumes[cell] = mesh::cell_volume(mesh, cell);
      }

      /** constant h_K^2 / mu int_K |f + div s_h|^2. */
      void
      add_inside(const unsigned int cell)
      {
        const Tensor<1, 3> divergence = stress_divergence(cell);
        const double       volume     = volumes[cell];
        double             sum        = 0.;
        if (loads.is_constant_in(cell))
          sum
            = (divergence + loads.body_force(cell, mesh.points[mesh.cells[cell][0]])).norm_square();
        else
          for (const auto &point : loads.cell_points(cell))
            sum += point.weight
                   * (divergence + loads.body_force(cell, compare::position(mesh, cell, point.b)))
                       .norm_square();
        double area = 0.;
        for (const auto &v : mesh::face_vertices)
          area += area_vector(cell, v).norm();
        const double h = 12. * volume / area; // three times the volume over the mean area
        squares[cell] += constant * h * h / stress.materials()[cell].shear_modulus * sum * volume;
      }

      /** In mixed form: int_K |div u_h - tr eps_thermal + c p_h|^2 / (1/(2 mu + gamma) + c) with
       * c = 1/(lambda - gamma), the energy of the volume that the cell misses. */
      void
      add_volume(const unsigned int            cell,
                 const mesh::NodalField       &u_h,
                 const mechanics::MaterialMap &materials)
      {
        const int                region    = mesh.regions[cell];
        const laws::PressureForm form      = materials.pressure_form(region);
        const auto              &rule      = compare::tet_quadrature(2);
        const auto               gradients = compare::vertex_gradients(u_h, cell);
        double                   sum       = 0.;
        for (unsigned int q = 0; q < rule.points.size(); ++q)
          {
            const mesh::Barycentric &b       = rule.points[q];
            double                   missing = form.inverse_rest * u_h.pressure->value(cell, b);
            for (unsigned int i = 0; i < 4; ++i)
              missing += b[i] * trace(gradients[i]);
            if (stress.has_thermal_strain())
              missing -= trace(materials.thermal_strain(region, compare::position(mesh, cell, b)));
            sum += rule.weights[q] * missing * missing;
          }
        squares[cell] += volumes[cell] * sum
                         / (1. / (2. * form.shear_modulus + form.kept_lambda) + form.inverse_rest);
      }

      /** The face @p local of @p cell, between it and @p neighbor. */
      void
      add_interior_face(const unsigned int cell,
                        const unsigned int local,
                        const unsigned int neighbor)
      {
        const auto  &v      = mesh::face_vertices[local];
        Tensor<1, 3> normal = area_vector(cell, v);
        normal /= normal.norm();
        double                 Q[3][3] = {};
        const ElasticMatrices &mine    = stress.materials()[cell],
                              &other   = stress.materials()[neighbor];
        add_acoustic_tensor(&mine == &other ? 1. : 0.5, mine, normal, Q);
        if (&mine != &other)
          add_acoustic_tensor(0.5, other, normal, Q);
        const InverseNorm norm(Q);
        double            sum = 0.;
        if (stress.has_thermal_strain())
          {
            const FacePlace place = face_place(cell, local);
            for (unsigned int q = 0; q < 3; ++q)
              sum += norm.square(jump_at(cell, neighbor, place, q)) / 3.;
          }
        else if (degree == 1)
          sum = norm.square(jump_between(stress.elastic(cell), stress.elastic(neighbor), normal));
        else
          {
            // Linear: at a point of the rule, half the sum at the corners and half the corner's.
            Tensor<1, 3> at_corners[3], half;
            for (unsigned int i = 0; i < 3; ++i)
              {
                at_corners[i] = jump_between(stress.elastic(cell) + 6 * v[i],
                                             stress.elastic(neighbor)
                                               + 6 * local_number(neighbor, mesh.cells[cell][v[i]]),
                                             normal);
                half += at_corners[i] / 6.;
              }
            for (const Tensor<1, 3> &corner : at_corners)
              sum += norm.square(half + 0.5 * corner) / 3.;
          }
        // Heights 3 V / area, times the area.
        squares[cell] += constant * 3. * volumes[cell] * sum;
        squares[neighbor] += constant * 3. * volumes[neighbor] * sum;
      }

      /** The face @p local of @p cell, listed as boundary face @p face. */
      void
      add_boundary_face(const unsigned int cell, const unsigned int local, const unsigned int face)
      {
        const unsigned char known = loads.known_components(face);
        if (known == 0 && !loads.slides(face))
          return;
        const FacePlace           place = face_place(cell, local);
        std::vector<Tensor<1, 3>> directions; // in which a sliding face's traction is known
        if (loads.slides(face))
          directions = loads.known_directions(face, place.normal);

        double Q[3][3] = {};
        add_acoustic_tensor(1., stress.materials()[cell], place.normal, Q);
        const InverseNorm norm(Q);
        double            sum = 0.;
        const auto        add = [&](const mesh::Barycentric &b, const Point<3> &x, double weight) {
          double s[6];
          stress.at(cell, b, x, s);
          Tensor<1, 3> missing = -traction(s, place.normal);
          if (loads.has_traction(face))
            missing += loads.traction(face, x, place.normal);
          if (loads.slides(face))
            {
              Tensor<1, 3> known_part;
              for (const Tensor<1, 3> &d : directions)
                known_part += (d * missing) * d;
              missing = known_part;
            }
          else
            for (unsigned int c = 0; c < 3; ++c)
              if ((known >> c & 1) == 0)
                missing[c] = 0.;
          sum += weight * norm.square(missing);
        };
        if (loads.is_constant_on(face))
          for (unsigned int q = 0; q < 3; ++q)
            add(place.barycentric[q], place.points[q], 1. / 3.);
        else
          for (const auto &point : loads.face_points(face))
            {
              mesh::Barycentric b{{0., 0., 0., 0.}};
              for (unsigned int k = 0; k < 3; ++k)
                b[local_number(cell, mesh.faces[face].vertices[k])] = point.b[k];
              add(b, compare::position(mesh, cell, b), point.weight);
            }
        squares[cell] += 2. * constant * 3. * volumes[cell] * sum;
      }

      std::vector<double> &
      squared_indicators()
      {
        return squares;
      }

    private:
      /** The rule of degree 2 with three points inside of a face. */
      struct FacePlace
      {
        Tensor<1, 3>      normal; ///< out of the cell
        mesh::Barycentric barycentric[3];
        Point<3>          points[3];
      };

      /** Which vertex of @p cell point @p vertex is. */
      unsigned int
      local_number(const unsigned int cell, const unsigned int vertex) const
      {
        unsigned int i = 0;
        while (mesh.cells[cell][i] != vertex)
          ++i;
        return i;
      }

      static Tensor<1, 3>
      jump_between(const double *mine, const double *other, const Tensor<1, 3> &normal)
      {
        double jump[6];
        for (unsigned int c = 0; c < 6; ++c)
          jump[c] = mine[c] - other[c];
        return traction(jump, normal);
      }

      /** The jump of the traction at point @p q of a face, stresses of any form. */
      Tensor<1, 3>
      jump_at(const unsigned int cell,
              const unsigned int neighbor,
              const FacePlace   &place,
              const unsigned int q) const
      {
        double mine[6], other[6];
        stress.at(cell, place.barycentric[q], place.points[q], mine);
        stress.at(neighbor,
                  mesh::barycentric_coordinates(mesh, neighbor, place.points[q]),
                  place.points[q],
                  other);
        return jump_between(mine, other, place.normal);
      }

      Tensor<1, 3>
      area_vector(const unsigned int cell, const std::array<unsigned int, 3> &v) const
      {
        const auto &points = mesh.points;
        const auto &c      = mesh.cells[cell];
        return 0.5
               * dealii::cross_product_3d(points[c[v[1]]] - points[c[v[0]]],
                                          points[c[v[2]]] - points[c[v[0]]]);
      }

      FacePlace
      face_place(const unsigned int cell, const unsigned int local) const
      {
        FacePlace   place;
        const auto &v = mesh::face_vertices[local];
        place.normal  = area_vector(cell, v);
        place.normal /= place.normal.norm();
        for (unsigned int q = 0; q < 3; ++q)
          {
            place.barycentric[q].fill(0.);
            for (unsigned int i = 0; i < 3; ++i)
              place.barycentric[q][v[i]] = i == q ? 2. / 3. : 1. / 6.;
            place.points[q] = compare::position(mesh, cell, place.barycentric[q]);
          }
        return place;
      }

      Tensor<1, 3>
      stress_divergence(const unsigned int cell) const
      {
        Tensor<1, 3> result;
        if (degree == 1 && !stress.has_thermal_strain())
          return result;
        const auto g = mesh::barycentric_gradients(mesh, cell);
        for (unsigned int i = 0; i < 4; ++i)
          {
            mesh::Barycentric b{{0., 0., 0., 0.}};
            b[i] = 1.;
            double s[6]; // a thermal stress is taken as linear between the vertices
            stress.at(cell, b, mesh.points[mesh.cells[cell][i]], s);
            result += traction(s, g[i]);
          }
        return result;
      }

      const mesh::TetMesh &mesh;
      unsigned int         degree;
      const CellStress    &stress;
      const GivenLoads    &loads;
      double               constant;
      std::vector<double>  squares, volumes; ///< one a cell
    };
  } // namespace

  EstimatorTraits
  Residual::traits() const
  {
    EstimatorTraits traits;
    traits.name          = "residual";
    traits.documentation = "Element residuals, jumps of the traction and what is missing to given "
                           "tractions, with the constants of Kelly, Gago, Zienkiewicz and Babuska "
                           "(1983). Bounds the energy norm of the error up to a constant that it "
                           "does not know.";
    return traits;
  }

  Estimate
  Residual::estimate(const EstimateInput &input) const
  {
    const mesh::NodalField       &u_h          = input.comparison.displacement();
    const mesh::TetMesh          &mesh         = u_h.mesh();
    const mechanics::MaterialMap &materials    = input.comparison.material_map();
    const MPI_Comm                communicator = input.comparison.mpi_communicator();
    const CellStress              stress(u_h, materials);
    const GivenLoads              loads(input.scene, materials, u_h);
    ResidualTerms                 terms(u_h, stress, loads);
    core::together(communicator, [&] {
      const compare::Slice slice   = compare::own_slice(mesh.n_cells(), communicator);
      const unsigned int   n_slots = 4 * mesh.n_cells();
      if (loads.has_body_force() || u_h.degree() == 2 || stress.has_thermal_strain())
        for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
          {
            terms.add_inside(cell);
            if (u_h.pressure)
              terms.add_volume(cell, u_h, materials);
          }
      mesh::FaceTable(mesh).for_each_triangle(
        [&](const mesh::FaceTable::Entry *first, const mesh::FaceTable::Entry *last) {
          const unsigned int cell = first->slot / 4;
          if (last - first != 2 || cell < slice.begin || cell >= slice.end)
            return;
          if (first[1].slot < n_slots)
            terms.add_interior_face(cell, first->slot % 4, first[1].slot / 4);
          else
            terms.add_boundary_face(cell, first->slot % 4, first[1].slot - n_slots);
        });
    });
    Estimate result;
    result.indicators = std::move(terms.squared_indicators());
    compare::sum_over_ranks(result.indicators, communicator);
    for (double &indicator : result.indicators)
      indicator = std::sqrt(std::max(indicator, 0.));
    result.global = compare::root_of_squares(result.indicators);
    return result;
  }
} // namespace tetradapt::estimate
