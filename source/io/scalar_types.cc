// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/io/scalar_types.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace tetradapt::io
{
  std::size_t
  size_of(const ScalarType type)
  {
    switch (type)
      {
      case ScalarType::int8:
      case ScalarType::uint8:
        return 1;
      case ScalarType::int16:
      case ScalarType::uint16:
        return 2;
      case ScalarType::int32:
      case ScalarType::uint32:
      case ScalarType::float32:
        return 4;
      default:
        return 8;
      }
  }



  namespace
  {
    bool
    find(const std::map<std::string, ScalarType> &types, const std::string &name, ScalarType &type)
    {
      const auto found = types.find(name);
      if (found == types.end())
        return false;
      type = found->second;
      return true;
    }



    /** A floating-point number that no integer can stand for becomes the smallest
     * one, which no list of indices allows. */
    template <typename From, typename To>
    To
    cast(const From value)
    {
      if constexpr (std::is_floating_point_v<From> && std::is_integral_v<To>)
        if (!(std::abs(value) < From(9e18)))
          return INT64_MIN;
      return static_cast<To>(value);
    }



    template <typename From, typename To>
    void
    convert_from(const unsigned char *data, const std::size_t n, const bool swap, To *values)
    {
      for (std::size_t i = 0; i < n; ++i)
        {
          unsigned char buffer[sizeof(From)];
          std::memcpy(buffer, data + i * sizeof(From), sizeof(From));
          if (swap)
            std::reverse(buffer, buffer + sizeof(From));
          From value;
          std::memcpy(&value, buffer, sizeof(From));
          values[i] = cast<From, To>(value);
        }
    }



    template <typename To>
    void
    convert_any(const ScalarType     type,
                const unsigned char *data,
                const std::size_t    n,
                const bool           swap,
                To                  *values)
    {
      switch (type)
        {
        case ScalarType::int8:
          return convert_from<std::int8_t>(data, n, swap, values);
        case ScalarType::uint8:
          return convert_from<std::uint8_t>(data, n, swap, values);
        case ScalarType::int16:
          return convert_from<std::int16_t>(data, n, swap, values);
        case ScalarType::uint16:
          return convert_from<std::uint16_t>(data, n, swap, values);
        case ScalarType::int32:
          return convert_from<std::int32_t>(data, n, swap, values);
        case ScalarType::uint32:
          return convert_from<std::uint32_t>(data, n, swap, values);
        case ScalarType::int64:
          return convert_from<std::int64_t>(data, n, swap, values);
        case ScalarType::uint64:
          return convert_from<std::uint64_t>(data, n, swap, values);
        case ScalarType::float32:
          return convert_from<float>(data, n, swap, values);
        case ScalarType::float64:
          return convert_from<double>(data, n, swap, values);
        }
    }
  } // namespace



  bool
  xml_scalar_type(const std::string &name, ScalarType &type)
  {
    static const std::map<std::string, ScalarType> types{{"Int8", ScalarType::int8},
                                                         {"UInt8", ScalarType::uint8},
                                                         {"Int16", ScalarType::int16},
                                                         {"UInt16", ScalarType::uint16},
                                                         {"Int32", ScalarType::int32},
                                                         {"UInt32", ScalarType::uint32},
                                                         {"Int64", ScalarType::int64},
                                                         {"UInt64", ScalarType::uint64},
                                                         {"Float32", ScalarType::float32},
                                                         {"Float64", ScalarType::float64}};
    return find(types, name, type);
  }



  bool
  legacy_scalar_type(const std::string &name, ScalarType &type)
  {
    // VTK writes its own vtkIdType as int into legacy files.
    static const std::map<std::string, ScalarType> types{{"char", ScalarType::int8},
                                                         {"signed_char", ScalarType::int8},
                                                         {"unsigned_char", ScalarType::uint8},
                                                         {"short", ScalarType::int16},
                                                         {"unsigned_short", ScalarType::uint16},
                                                         {"int", ScalarType::int32},
                                                         {"vtkidtype", ScalarType::int32},
                                                         {"unsigned_int", ScalarType::uint32},
                                                         {"long", ScalarType::int64},
                                                         {"vtktypeint64", ScalarType::int64},
                                                         {"unsigned_long", ScalarType::uint64},
                                                         {"vtktypeuint64", ScalarType::uint64},
                                                         {"float", ScalarType::float32},
                                                         {"double", ScalarType::float64}};
    return find(types, name, type);
  }



  bool
  is_little_endian()
  {
    const std::uint16_t one = 1;
    unsigned char       first;
    std::memcpy(&first, &one, 1);
    return first == 1;
  }



  void
  convert(const ScalarType     type,
          const unsigned char *data,
          const std::size_t    n,
          const bool           swap,
          double              *values)
  {
    convert_any(type, data, n, swap, values);
  }



  void
  convert(const ScalarType     type,
          const unsigned char *data,
          const std::size_t    n,
          const bool           swap,
          std::int64_t        *values)
  {
    convert_any(type, data, n, swap, values);
  }
} // namespace tetradapt::io
