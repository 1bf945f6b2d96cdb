#pragma once
// The user's interaction with a growing picture. [[stage]] in the experiment file lists successive
// limits for the interactive phase, and [[order]] lists orders of the user. Each program defines
// its own type Limits and the fields of Limits.
#include <fmt/format.h>

#include "simulator/programs/declare/program.hpp"

namespace ray_tracing {

struct NonInteractive {};  ///< leave the interactive phase now
struct Interactive {};     ///< return to the interactive phase
struct Abort {};           ///< send no further tasks and end with the picture as it is
struct Leave {};           ///< the user leaves, and the run continues to its end
struct Save {              ///< save the picture as it is
  std::string name;        ///< part of the file name
};

/// An order of the user. Its time is in seconds since the first task.
template <class Limits>
struct Order {
  machine::Seconds at;
  std::variant<NonInteractive, Interactive, Abort, Leave, Save, Limits> what;
};

/// An [[order]] as written in an experiment file.
template <class Limits>
struct OrderRecord {
  double at_s = 0;
  bool non_interactive = false, interactive = false, abort = false, leave = false;
  std::string save;
  std::optional<Limits> limits;  ///< only if the record contains any limit
};

/// True if `name` can be part of a file name: at most 40 letters, digits and dashes.
bool is_picture_name(const std::string& name);
/// Throws base::BadInput if two names are equal, or if a name starts as the program's own pictures
/// do (stage, order, shown, growth, borders).
void check_saved_names(const std::vector<std::string>& names);

/// Throws base::BadInput if orders are not sorted by time, if an order follows a Leave, or if names
/// of pictures are invalid.
template <class Limits>
void check_script(const std::vector<Order<Limits>>& script) {
  std::vector<std::string> names;
  for (const auto& order : script)
    if (const auto* save = std::get_if<Save>(&order.what)) names.push_back(save->name);
  check_saved_names(names);
  for (std::size_t i = 1; i < script.size(); ++i)
    base::require(script[i].at >= script[i - 1].at, fmt::format("order {}", i + 1),
                  "found the time {} s, expected at least that of the previous order",
                  script[i].at.value);
  for (std::size_t i = 1; i < script.size(); ++i)
    base::require(!std::holds_alternative<Leave>(script[i - 1].what),
                  fmt::format("order {}", i + 1),
                  "found one after the user has left, expected none");
}

/// The fields of an [[order]]: at_s, non_interactive, interactive, abort, leave and save, and those
/// of the limits.
template <class Limits>
base::Fields<OrderRecord<Limits>> order_fields(const base::Fields<Limits>& limit_fields) {
  using Record = OrderRecord<Limits>;
  using D = base::Declare<Record>;
  const auto set_save = [](Record& r, const base::Scalar& value) {
    const auto& name = std::get<std::string>(value);
    if (!is_picture_name(name)) return false;
    r.save = name;
    return true;
  };
  return base::join(
      base::Fields<Record>{
          D::number("at_s", &Record::at_s, 0, 1e9, "s", "time of the order, from the first task"),
          D::flag("non_interactive", &Record::non_interactive,
                  "true: the user leaves the interactive phase"),
          D::flag("interactive", &Record::interactive,
                  "true: the user returns to the interactive phase"),
          D::flag("abort", &Record::abort,
                  "true: the user aborts the run; only rays already sent are completed"),
          D::flag("leave", &Record::leave,
                  "true: the user leaves and the rest is computed without limits; default: after "
                  "the last order"),
          D::custom(
              "save",
              {.kind = base::Domain::Kind::text, .expected = "up to 40 letters, digits and dashes"},
              "", "saves the current picture, with this text in the file's name", set_save,
              [](const Record& r) { return r.save; })},
      {base::lift_optional<Record>(limit_fields, &Record::limits)});
}

/// Converts a record to an order. Throws base::BadInput unless the record contains exactly one
/// order.
template <class Limits>
Order<Limits> make_order(const OrderRecord<Limits>& record) {
  std::vector<Order<Limits>> orders;
  const auto add = [&](const auto& what) { orders.push_back({{record.at_s}, what}); };
  if (record.limits) add(*record.limits);
  if (record.non_interactive) add(NonInteractive{});
  if (record.interactive) add(Interactive{});
  if (record.abort) add(Abort{});
  if (record.leave) add(Leave{});
  if (!record.save.empty()) add(Save{record.save});
  if (orders.size() != 1)
    throw base::BadInput(
        fmt::format("[[order]] at {} s: found {}, expected one of: limits, non_interactive = true, "
                    "interactive = true, abort = true, leave = true, save = \"name\"",
                    record.at_s, orders.empty() ? "no order" : "several orders"));
  return orders[0];
}

/// Declares a list of tables in the experiment file, which is stored in a program's parameters of
/// type P. `list` is a pointer to a member of P, or a function from P& to a reference to the list.
/// `append` converts a record to an element of the list.
template <class P, class Record, class Access, class Append>
programs::RecordList make_list(const std::string& key, const std::string& help,
                               const base::Fields<Record>& fields, Access list, Append append) {
  const auto find = [list](std::any & params) -> auto& {
    return std::invoke(list, std::any_cast<P&>(params));
  };
  return {key,
          help,
          base::lift_all<std::any>(fields, base::AnyAs<Record>{}),
          [] { return Record{}; },
          [find](std::any& params) { find(params).clear(); },
          [find, append](std::any& params, const std::any& any) {
            find(params).push_back(append(std::any_cast<const Record&>(any)));
          }};
}

/// Declares the lists [[stage]] and [[order]]. `stages` and `script` give access to the members of
/// P that hold the vectors of Limits and of Order<Limits>.
template <class P, class Limits, class Stages, class Script>
std::vector<programs::RecordList> make_lists(const base::Fields<Limits>& limit_fields,
                                             Stages stages, Script script) {
  return {make_list<P>("stage",
                       "limits of the interactive phase; each [[stage]] replaces the previous one",
                       limit_fields, stages, [](const Limits& limits) { return limits; }),
          make_list<P>("order", "an order of the user, at_s seconds after the first task",
                       order_fields(limit_fields), script, &make_order<Limits>)};
}

}  // namespace ray_tracing
