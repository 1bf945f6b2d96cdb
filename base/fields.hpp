#pragma once
// Declarations of parameters and measurements, each in one place. Parameters are the members of a
// struct, with their defaults. A list of fields declares the name, domain and help text of each
// parameter. Experiment files, the command line, its help, the manual and the tables of results use
// this list. A list of columns declares measurements in the same way.
#include <algorithm>
#include <any>
#include <cmath>

#include <concepts>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "base/errors.hpp"

namespace base {

/// The name of a file or of a generator such as "tree:7". `text` is the name as spelled by the
/// user; `path` is the path of the file, or "" for a generator.
struct Source {
  std::string text, path;
  bool operator==(const Source&) const = default;
};

/// A value from a file or a command line. Empty if no value was given.
using Scalar =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>,
                 Source, std::vector<std::string>, std::vector<std::vector<double>>>;

/// The value as text for human readers; "none" for an empty value.
std::string to_text(const Scalar& value);

/// A cell of a table; may be empty.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// The values that a field may hold.
struct Domain {
  enum class Kind {
    flag,    ///< true, false, 1 or 0
    whole,   ///< an integer from `low` to `high`
    number,  ///< a number from `low` to `high`
    choice,  ///< one of `choices`
    text,
    list,         ///< a list of numbers
    texts,        ///< a list of texts; a single text counts as a list of one
    expression,   ///< a text, or a number as text
    expressions,  ///< a list of expressions
    any,          ///< a value described by `expected` and checked by Field::write
    file,         ///< a file name
    source        ///< a file name with an extension, or a generator
  };
  Kind kind = Kind::number;
  double low = 0, high = 0;
  std::vector<std::string> choices = {};
  bool is_required = false;   ///< a value must be given
  std::string expected = {};  ///< overrides the text that `describe` makes

  /// Describes the expected values, as in "a whole number from 0 to 16" or "one of red, green".
  std::string describe() const;
  /// True if the value is of the kind `kind` and in its range.
  bool allows(const Scalar& value) const;
};

/// One parameter: a member of the struct P, with functions that read and write it.
template <class P>
struct Field {
  std::string name;  ///< key in experiment files, option on the command line, column of tables
  std::string unit;  ///< such as "bytes"; "" if the parameter has no unit
  std::string help;
  Domain domain;
  /// The address of the member, for `write`. If the member is inside an empty std::optional, fills
  /// the optional first.
  std::function<void*(P&)> place;
  /// The address of the member, for `read`.
  std::function<const void*(const P&)> find;
  /// Sets the member to a value that the domain allows. Returns false to refuse the value.
  std::function<bool(void* member, const Scalar&)> write;
  std::function<Scalar(const void* member)> read;

  Scalar get(const P& params) const { return read(find(params)); }
  /// Checks the value and sets the parameter to it; returns "". For a value that is refused,
  /// changes nothing and returns a description of the expected values.
  std::string assign(P& params, const Scalar& value) const {
    return domain.allows(value) && write(place(params), value) ? "" : domain.describe();
  }
};
template <class P>
using Fields = std::vector<Field<P>>;

/// Pairs of a name and a value of the enum E, in the order of the help text.
template <class E>
using Names = std::vector<std::pair<std::string, E>>;

namespace detail {

template <class T>
constexpr bool is_quantity = requires(T t) {
  t.value;
}
&&!requires(T t) { t.has_value(); };
template <class T>
constexpr bool is_optional = requires(T t) {
  t.has_value();
};

/// The number or text inside a member that may be an optional, or a struct with a member `value`.
/// Fills an empty optional.
template <class T>
auto& plain(T& member) {
  if constexpr (is_optional<T>)
    return plain(member.emplace());
  else if constexpr (is_quantity<T>)
    return plain(member.value);
  else
    return member;
}

template <class T>
bool store(void* member, const Scalar& value) {
  auto& target = plain(*static_cast<T*>(member));
  using Target = std::remove_reference_t<decltype(target)>;
  if constexpr (!std::is_arithmetic_v<Target>)
    target = std::get<Target>(value);
  else if (const auto* whole = std::get_if<std::int64_t>(&value))
    target = static_cast<Target>(*whole);
  else if (const auto* number = std::get_if<double>(&value))
    target = static_cast<Target>(std::integral<Target> ? std::round(*number) : *number);
  else
    target = static_cast<Target>(std::get<bool>(value));
  return true;
}

template <class T>
Scalar load(const T& member) {
  if constexpr (is_optional<T>)
    return member ? load(*member) : Scalar();
  else if constexpr (is_quantity<T>)
    return load(member.value);
  else if constexpr (std::same_as<T, bool> || std::integral<T>)
    return static_cast<std::int64_t>(member);
  else if constexpr (std::floating_point<T>)
    return static_cast<double>(member);
  else
    return member;
}

/// The type of the member that `access` finds in a P.
template <class P, class Access>
using Member = std::remove_reference_t<std::invoke_result_t<Access, P&>>;

template <class P, class Access, class Write, class Read>
Field<P> make_field(const std::string& name, Access access, Domain domain, const std::string& unit,
                    const std::string& help, Write write, Read read) {
  return {name,
          unit,
          help,
          std::move(domain),
          [access](P& p) { return &std::invoke(access, p); },
          [access](const P& p) { return &std::invoke(access, p); },
          write,
          read};
}

template <class P, class Access>
Field<P> make_field(const std::string& name, Access access, Domain domain, const std::string& unit,
                    const std::string& help) {
  using T = Member<P, Access>;
  return make_field<P>(name, access, std::move(domain), unit, help, &store<T>,
                       [](const void* member) { return load(*static_cast<const T*>(member)); });
}

}  // namespace detail

/// Makes fields of P: `Declare<Params> d; d.whole("bytes", &Params::bytes, 1, 1e9, "bytes", "length
/// of a message")`. `access` is a pointer to a member of P, or `[](auto& p) -> auto& { ... }`. A
/// numeric member may be optional, or a struct with a member `value`. An optional stays empty
/// unless a value is given.
template <class P>
struct Declare {
  template <Domain::Kind kind>
  struct Ranged {
    template <class Access>
    Field<P> operator()(const std::string& name, Access access, double low, double high,
                        const std::string& unit, const std::string& help) const {
      return detail::make_field<P>(name, access, {kind, low, high}, unit, help);
    }
  };
  template <Domain::Kind kind>
  struct Plain {
    template <class Access>
    Field<P> operator()(const std::string& name, Access access, const std::string& help,
                        bool is_required = false) const {
      return detail::make_field<P>(name, access, {kind, 0, 1, {}, is_required}, "", help);
    }
  };
  static constexpr Ranged<Domain::Kind::whole> whole{};
  static constexpr Ranged<Domain::Kind::number> number{};
  static constexpr Plain<Domain::Kind::flag> flag{};
  static constexpr Plain<Domain::Kind::text> text{};
  static constexpr Plain<Domain::Kind::file> file{};
  static constexpr Plain<Domain::Kind::source> source{};
  static constexpr Plain<Domain::Kind::texts> texts{};
  static constexpr Plain<Domain::Kind::expression> expression{};
  /// A field for a text that must be one of `choices`.
  template <class Access>
  static Field<P> one_of(const std::string& name, Access access,
                         const std::vector<std::string>& choices, const std::string& help) {
    return detail::make_field<P>(name, access, {Domain::Kind::choice, 0, 0, choices}, "", help);
  }
  /// A field for an enum, set by the name of a value.
  template <class Access, class E>
  static Field<P> choice(const std::string& name, Access access, const Names<E>& names,
                         const std::string& help) {
    Domain domain{Domain::Kind::choice};
    for (const auto& [key, value] : names) domain.choices.push_back(key);
    using T = detail::Member<P, Access>;
    return detail::make_field<P>(
        name, access, domain, "", help,
        [names](void* member, const Scalar& value) {
          for (const auto& [key, meaning] : names)
            if (key == std::get<std::string>(value)) *static_cast<T*>(member) = meaning;
          return true;
        },
        [names](const void* member) {
          for (const auto& [key, meaning] : names)
            if (meaning == *static_cast<const T*>(member)) return Scalar(key);
          throw InvariantBroken("a choice without a name");
        });
  }
  /// A field read by `get(const P&)` and written by `set(P&, value)`.
  template <class Set, class Get>
  static Field<P> custom(const std::string& name, const Domain& domain, const std::string& unit,
                         const std::string& help, Set set, Get get) {
    return detail::make_field<P>(
        name, std::identity(), domain, unit, help,
        [set](void* p, const Scalar& value) { return set(*static_cast<P*>(p), value); },
        [get](const void* p) -> Scalar { return get(*static_cast<const P*>(p)); });
  }
};

/// Makes a field of the struct P from a field of the struct Inner. `access` returns the Inner in a
/// P.
template <class P, class Inner, class Access>
Field<P> lift(const Field<Inner>& field, Access access) {
  return {field.name,
          field.unit,
          field.help,
          field.domain,
          [place = field.place, access](P& p) { return place(std::invoke(access, p)); },
          [find = field.find, access](const P& p) { return find(std::invoke(access, p)); },
          field.write,
          field.read};
}
/// Applies lift() to all fields and prefixes their names with `prefix`.
template <class P, class Inner, class Access>
Fields<P> lift_all(const Fields<Inner>& fields, Access access, const std::string& prefix = "") {
  Fields<P> all;
  for (const auto& field : fields) {
    all.push_back(lift<P>(field, access));
    all.back().name = prefix + field.name;
  }
  return all;
}

/// Makes fields of P from the fields of an Inner that a P may contain. Setting such a field creates
/// the Inner. If there is no Inner, a field has the value that it has in a default Inner.
template <class P, class Inner>
Fields<P> lift_optional(const Fields<Inner>& fields, std::optional<Inner> P::*inner,
                        const std::string& prefix = "") {
  Fields<P> all;
  for (const auto& field : fields)
    all.push_back({prefix + field.name, field.unit, field.help, field.domain,
                   [place = field.place, inner](P& p) {
                     return place(p.*inner ? *(p.*inner) : (p.*inner).emplace());
                   },
                   [find = field.find, inner](const P& p) {
                     static const Inner standard{};
                     return find(p.*inner ? *(p.*inner) : standard);
                   },
                   field.write, field.read});
  return all;
}

/// Returns the P inside a std::any.
template <class P>
struct AnyAs {
  P& operator()(std::any& any) const { return std::any_cast<P&>(any); }
  const P& operator()(const std::any& any) const { return std::any_cast<const P&>(any); }
};

/// The fields with the given names, in the order of `names`. Throws InvariantBroken for an unknown
/// name.
template <class P>
Fields<P> select(const Fields<P>& fields, std::initializer_list<std::string_view> names) {
  Fields<P> chosen;
  for (const auto name : names) {
    const auto found =
        std::ranges::find_if(fields, [&](const auto& field) { return field.name == name; });
    if (found == fields.end()) throw InvariantBroken("no field " + std::string(name));
    chosen.push_back(*found);
  }
  return chosen;
}

template <class T>
std::vector<T> join(std::vector<T> first, const std::vector<std::vector<T>>& others) {
  for (const auto& more : others) first.insert(first.end(), more.begin(), more.end());
  return first;
}

/// One measurement of a result R, or a family of measurements with a variable number of columns.
/// The family "stage{}_s" stands for stage1_s, stage2_s and so on. A family whose name has no {} is
/// a single column that some results lack.
template <class R>
struct Column {
  std::string name;  ///< includes the unit: "time_s"
  std::string help;
  /// Returns one cell; for a family, any number of cells.
  std::function<std::vector<Cell>(const R&)> get;
  bool is_family = false;
};
template <class R>
using Columns = std::vector<Column<R>>;

/// Converts a number or text to a cell. Empty optionals, infinities and NaN give an empty cell.
template <class T>
Cell to_cell(const T& value) {
  if constexpr (detail::is_optional<T>)
    return value ? to_cell(*value) : Cell();
  else if constexpr (detail::is_quantity<T>)
    return to_cell(value.value);
  else if constexpr (std::integral<T>)
    return static_cast<std::int64_t>(value);
  else if constexpr (std::floating_point<T>)
    return value - value == 0 ? Cell(static_cast<double>(value)) : Cell();
  else if constexpr (std::same_as<T, Cell>)
    return value;
  else
    return std::string(value);
}

/// Makes a column. `access` is a pointer to a member of R, or a function of a const R&. Its result
/// is a number or text, or a std::optional of either.
template <class R, class Access>
Column<R> column(const std::string& name, Access access, const std::string& help) {
  return {name, help,
          [access](const R& r) { return std::vector<Cell>{to_cell(std::invoke(access, r))}; }};
}
template <class R, class T>
requires std::is_member_object_pointer_v<T R::*> Column<R> column(const std::string& name,
                                                                  T R::*member,
                                                                  const std::string& help) {
  return column<R, T R::*>(name, member, help);
}
/// A column whose cells are empty, to be filled later by other code.
template <class R>
Column<R> empty_column(const std::string& name, const std::string& help) {
  return {name, help, [](const R&) { return std::vector<Cell>(1); }};
}
template <class R, class Inner, class Access>
Columns<R> lift_columns(const Columns<Inner>& columns, Access access) {
  Columns<R> all;
  for (const auto& c : columns)
    all.push_back({c.name, c.help,
                   [get = c.get, access](const R& r) { return get(std::invoke(access, r)); },
                   c.is_family});
  return all;
}

/// Columns that exist only for results for which `has` is true.
template <class R, class Has>
Columns<R> only_if(Has has, Columns<R> columns) {
  for (auto& c : columns) {
    c.get = [get = c.get, has](const R& r) {
      return std::invoke(has, r) ? get(r) : std::vector<Cell>();
    };
    c.is_family = true;
  }
  return columns;
}

/// The measurements of one run: names and cells, in the order of the columns of the experiment's
/// program.
using Row = std::vector<std::pair<std::string, Cell>>;
template <class R>
Row make_row(const Columns<R>& columns, const R& result) {
  Row row;
  for (const auto& c : columns) {
    const auto cells = c.get(result);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::string name = c.name;
      if (const auto at = name.find("{}"); c.is_family && at != std::string::npos)
        name.replace(at, 2, std::to_string(i + 1));
      row.emplace_back(std::move(name), cells[i]);
    }
  }
  return row;
}

}  // namespace base
