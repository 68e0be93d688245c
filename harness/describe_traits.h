#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "reckon/harness/describe.h"

namespace reckon::harness {

// What sort of value a C++ type is, for the archives.

template <class T>
struct ListTraits {
  static constexpr bool kIsList = false;
};
template <class E, std::size_t N>
struct ListTraits<std::array<E, N>> {
  static constexpr bool kIsList = true;
  static constexpr std::size_t kSize = N;
  using Element = E;
};
template <int N>
requires(N > 0) struct ListTraits<Eigen::Matrix<double, N, 1>> {
  static constexpr bool kIsList = true;
  static constexpr std::size_t kSize = N;
  using Element = double;
};
template <class E>
struct ListTraits<std::vector<E>> {
  static constexpr bool kIsList = true;
  static constexpr std::size_t kSize = 0;  // any
  using Element = E;
};

template <class T>
concept IsList = ListTraits<T>::kIsList;
template <class T>
concept IsFixedList = IsList<T> && ListTraits<T>::kSize >
0;
template <class T>
concept IsNumber = std::is_same_v<T, double> ||(std::is_integral_v<T> && !std::is_same_v<T, bool>);
template <class T>
concept IsWord = std::is_enum_v<T>;
template <class T>
concept IsText = std::is_same_v<T, std::string>;
template <class T>
concept IsFlag = std::is_same_v<T, bool>;
template <class T>
concept IsTextForm = TextForm<T>::kExists;

template <class T>
struct IsOptionalType : std::false_type {};
template <class E>
struct IsOptionalType<std::optional<E>> : std::true_type {};
template <class T>
concept IsOptional = IsOptionalType<T>::value;

template <class T>
struct IsMapType : std::false_type {};
template <class E>
struct IsMapType<std::map<std::string, E>> : std::true_type {};
template <class T>
concept IsMap = IsMapType<T>::value;

/// A struct with a Describe function.
template <class T>
concept IsStruct =
    std::is_class_v<T> && !IsList<T> && !IsMap<T> && !IsOptional<T> && !IsText<T> && !IsTextForm<T>;

}  // namespace reckon::harness
