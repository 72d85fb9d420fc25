#include "reduce/common/formula/formula_parser.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include "reduce/common/error.hpp"

namespace bielle {

namespace {

// muParser evaluates while it parses. Here the "numbers" that it handles are the indices of terms of the tree, so that
// one evaluation of the formula by muParser builds the tree. Its callbacks for operators have no argument for user
// data, hence this thread-local object.
struct Building {
  FormulaTree tree;
  std::string folder;
};
thread_local Building* building = nullptr;

struct BuildingScope {
  explicit BuildingScope(Building& mine) : before(building) { building = &mine; }
  ~BuildingScope() { building = before; }
  BuildingScope(const BuildingScope&) = delete;
  BuildingScope& operator=(const BuildingScope&) = delete;
  Building* before;
};

int index_of(double handle) { return static_cast<int>(handle); }

template <Operation operation>
double unary(double a) {
  return building->tree.add(operation, index_of(a));
}
template <Operation operation>
double binary(double a, double b) {
  return building->tree.add(operation, index_of(a), index_of(b));
}
template <Operation operation>
double ternary(double a, double b, double c) {
  return building->tree.add(operation, index_of(a), index_of(b), index_of(c));
}
template <Operation operation>
double many(const double* operands, int count) {
  double result = operands[0];
  for (int i = 1; i < count; ++i) result = binary<operation>(result, operands[i]);
  return result;
}
double average(const double* operands, int count) {
  return binary<Operation::divide>(many<Operation::add>(operands, count), building->tree.add_constant(count));
}
double same(double a) { return a; }

template <Interpolation::Kind kind>
double interpolation(const char* file, double operand) {
  const std::filesystem::path path = std::filesystem::path(building->folder) / file;
  auto function =
      std::make_shared<const Interpolation>(Interpolation::from_file(path.lexically_normal().string(), kind));
  return building->tree.add_interpolation(std::move(function), index_of(operand));
}

template <Interpolation::Kind kind>
double surface(const char* file, double x, double y) {
  const std::filesystem::path path = std::filesystem::path(building->folder) / file;
  auto function = std::make_shared<const Surface>(Surface::from_file(path.lexically_normal().string(), kind));
  return building->tree.add_surface(std::move(function), index_of(x), index_of(y));
}

/// Recognises a number at the start of `text`. (from_chars also takes "inf" and "nan", which are refused as names.)
int read_number(const char* text, int* position, double* handle) {
  if (!std::isdigit(static_cast<unsigned char>(*text)) && *text != '.') return 0;
  double number = 0;
  const auto [end, error] = std::from_chars(text, text + std::strlen(text), number);
  if (error == std::errc::result_out_of_range)
    throw InputError(fmt::format("the number {} is too large or too small", std::string(text, end)));
  if (error != std::errc()) return 0;
  *position += static_cast<int>(end - text);
  *handle = building->tree.add_constant(number);
  return 1;
}

template <Operation operation>
void define_unary(mu::Parser& parser, const char* name) {
  parser.DefineFun(name, unary<operation>, false);
}
template <Operation operation>
void define_operator(mu::Parser& parser, const char* symbol, mu::EOprtPrecedence precedence) {
  parser.DefineOprt(symbol, binary<operation>, precedence, operation == Operation::power ? mu::oaRIGHT : mu::oaLEFT,
                    false);
}

void define_operators(mu::Parser& parser) {
  using enum Operation;
  define_operator<logical_or>(parser, "||", mu::prLOR);
  define_operator<logical_and>(parser, "&&", mu::prLAND);
  define_operator<less>(parser, "<", mu::prCMP);
  define_operator<less_or_equal>(parser, "<=", mu::prCMP);
  define_operator<greater>(parser, ">", mu::prCMP);
  define_operator<greater_or_equal>(parser, ">=", mu::prCMP);
  define_operator<equal>(parser, "==", mu::prCMP);
  define_operator<not_equal>(parser, "!=", mu::prCMP);
  define_operator<Operation::add>(parser, "+", mu::prADD_SUB);
  define_operator<subtract>(parser, "-", mu::prADD_SUB);
  define_operator<multiply>(parser, "*", mu::prMUL_DIV);
  define_operator<divide>(parser, "/", mu::prMUL_DIV);
  define_operator<power>(parser, "^", mu::prPOW);
  parser.DefineInfixOprt("-", unary<negate>, mu::prINFIX, false);
  parser.DefineInfixOprt("+", same, mu::prINFIX, false);
  parser.DefineInfixOprt("!", unary<logical_not>, mu::prINFIX, false);
}

void define_functions_of_one_number(mu::Parser& parser) {
  using enum Operation;
  define_unary<Operation::sin>(parser, "sin");
  define_unary<Operation::cos>(parser, "cos");
  define_unary<Operation::tan>(parser, "tan");
  define_unary<Operation::asin>(parser, "asin");
  define_unary<Operation::acos>(parser, "acos");
  define_unary<Operation::atan>(parser, "atan");
  define_unary<Operation::sinh>(parser, "sinh");
  define_unary<Operation::cosh>(parser, "cosh");
  define_unary<Operation::tanh>(parser, "tanh");
  define_unary<Operation::asinh>(parser, "asinh");
  define_unary<Operation::acosh>(parser, "acosh");
  define_unary<Operation::atanh>(parser, "atanh");
  define_unary<Operation::exp>(parser, "exp");
  define_unary<ln>(parser, "ln");
  define_unary<Operation::log2>(parser, "log2");
  define_unary<Operation::log10>(parser, "log10");
  define_unary<Operation::sqrt>(parser, "sqrt");
  define_unary<Operation::abs>(parser, "abs");
  define_unary<sign>(parser, "sign");
  define_unary<Operation::floor>(parser, "floor");
  define_unary<Operation::ceil>(parser, "ceil");
  define_unary<Operation::round>(parser, "round");
}

void define_functions_of_several_numbers(mu::Parser& parser) {
  using enum Operation;
  parser.DefineFun("atan2", binary<Operation::atan2>, false);
  parser.DefineFun("pow", binary<power>, false);
  parser.DefineFun("mod", binary<modulo>, false);
  parser.DefineFun("min", many<minimum>, false);
  parser.DefineFun("max", many<maximum>, false);
  parser.DefineFun("sum", many<Operation::add>, false);
  parser.DefineFun("avg", average, false);
  parser.DefineFun("if", ternary<select>, false);
  parser.DefineFun("step", ternary<step>, false);
  parser.DefineFun("ramp", ternary<ramp>, false);
  parser.DefineFun("pulse", ternary<pulse>, false);
  parser.DefineFun("table", interpolation<Interpolation::Kind::linear>, false);
  parser.DefineFun("spline", interpolation<Interpolation::Kind::cubic>, false);
  parser.DefineFun("table2", surface<Interpolation::Kind::linear>, false);
  parser.DefineFun("spline2", surface<Interpolation::Kind::cubic>, false);
}

void define_language(mu::Parser& parser) {
  parser.EnableBuiltInOprt(false);
  parser.ClearFun();
  parser.ClearConst();
  parser.ClearInfixOprt();
  parser.ClearPostfixOprt();
  parser.ClearOprt();
  parser.AddValIdent(read_number);
  define_operators(parser);
  define_functions_of_one_number(parser);
  define_functions_of_several_numbers(parser);
}

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = [] {
    mu::Parser parser;
    define_language(parser);
    std::vector<std::string> all;
    for (const auto& [name, callback] : parser.GetFunDef()) all.push_back(name);
    return all;
  }();
  return names;
}

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Returns the formula with blanks in place of quoted parts.
std::string without_quoted(std::string text) {
  bool inside = false;
  for (char& c : text) {
    if (c == '"') inside = !inside;
    if (inside) c = ' ';
  }
  return text;
}

/// Returns the end of the name or number that begins at `i`.
std::size_t end_of_word(const std::string& text, std::size_t i) {
  while (i < text.size() && is_name_character(text[i])) ++i;
  return i;
}

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t i = 0, end = 0; i < text.size(); i = end + 1) {
    end = end_of_word(text, i);
    if (end > i && !std::isdigit(static_cast<unsigned char>(text[i]))) names.push_back(text.substr(i, end - i));
  }
  return names;
}

/// Returns a part of the formula with the user's names of the variables.
std::string as_shown(const std::string& text, const std::vector<std::string>& variables,
                     const std::vector<std::string>& shown) {
  std::string result;
  for (std::size_t i = 0, end = 0; i < text.size(); i = end) {
    end = std::max(end_of_word(text, i), i + 1);
    const std::string word = text.substr(i, end - i);
    const auto variable = std::find(variables.begin(), variables.end(), word);
    result += variable == variables.end() ? word : shown[static_cast<std::size_t>(variable - variables.begin())];
  }
  return result;
}

/// Returns the nearest known name, or all allowed names.
std::string known_names(const std::string& name, const std::vector<std::string>& names) {
  if (!nearest_name(name, names).empty()) return did_you_mean(name, names);
  std::vector<std::string> own;
  for (const std::string& known : names)
    if (known != "pi" && !contains(function_names(), known)) own.push_back(known);
  const std::string functions = fmt::format("{}", fmt::join(function_names(), ", "));
  if (own.empty()) return "; there are no parameters or variables here, only pi and functions (" + functions + ")";
  return did_you_mean(name, own) + "; pi; or a function (" + functions + ")";
}

/// @param token  the part of the formula that the error is about
std::string explanation(const mu::ParserError& error, std::string token, const std::vector<std::string>& names) {
  token.erase(token.find_last_not_of(' ') + 1);
  const auto place = [&] { return error.GetPos() < 0 ? "" : fmt::format(" at character {}", error.GetPos() + 1); };
  switch (error.GetCode()) {
    case mu::ecEMPTY_EXPRESSION:
      return "the formula is empty";
    case mu::ecUNASSIGNABLE_TOKEN: {
      std::size_t length = 0;
      while (length < token.size() && is_name_character(token[length])) ++length;
      const std::string name = token.substr(0, length);
      if (name == "log") return "'log' may mean two things" + place() + "; write ln or log10";
      if (contains(function_names(), name))
        return fmt::format("the function '{}'{} must be followed by '('", name, place());
      if (length > 0 && !std::isdigit(static_cast<unsigned char>(name[0])))
        return fmt::format("unknown name '{}'{}{}", name, place(), known_names(name, names));
      if (token.starts_with("=")) return fmt::format("'='{} is no operator; to compare, write ==", place());
      return fmt::format("'{}'{} is not understood", token, place());
    }
    case mu::ecUNEXPECTED_EOF:
      return "the formula breaks off at its end";
    case mu::ecMISSING_PARENS:
      return "a ')' is missing";
    case mu::ecUNEXPECTED_PARENS:
      return fmt::format("unexpected '{}'{}", token, place());
    case mu::ecUNEXPECTED_ARG:
    case mu::ecUNEXPECTED_ARG_SEP:
      return "unexpected ','" + place() + "; a decimal point is written '.'";
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_FUN:
      return fmt::format("unexpected '{}'{}: an operator is missing before it", token, place());
    case mu::ecTOO_MANY_PARAMS:
      return fmt::format("too many arguments of '{}'{}", token, place());
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("too few arguments of '{}'{}", token, place());
    case mu::ecSTRING_EXPECTED:
    case mu::ecSTR_RESULT:
    case mu::ecVAL_EXPECTED:
    case mu::ecUNTERMINATED_STRING:
      return "a quoted file name is expected in table, spline, table2 and spline2, and there alone" + place();
    case mu::ecUNEXPECTED_OPERATOR:
      if (token == "=") return fmt::format("'='{} is no operator; to compare, write ==", place());
      return fmt::format("unexpected '{}'{}: a number or a name is missing before it", token, place());
    default:
      return error.GetMsg();
  }
}

/// The names that a formula may use, registered with muParser together with their terms.
class Vocabulary {
 public:
  Vocabulary(mu::Parser& parser, Building& mine, const std::vector<std::string>& variables,
             const std::vector<std::string>& shown, const std::map<std::string, double>& constants,
             const std::vector<std::string>& used) {
    names_ = built_in_names();
    parser.DefineConst("pi", mine.tree.add_constant(std::numbers::pi));
    for (const auto& [name, value] : constants) {
      if (!contains(used, name)) {
        names_.push_back(name);
        continue;
      }
      if (contains(variables, name))
        throw InputError(
            fmt::format("'{}' is both a parameter and a variable of this formula; rename the parameter", name));
      if (contains(names_, name))
        throw InputError(fmt::format("the parameter '{}' has the name of something built in; rename it", name));
      names_.push_back(name);
      parser.DefineConst(name, mine.tree.add_constant(value));
    }
    handles_.reserve(variables.size());
    names_.insert(names_.end(), shown.begin(), shown.end());
    for (const std::string& name : variables) {
      handles_.push_back(mine.tree.add_argument(static_cast<int>(handles_.size())));
      parser.DefineVar(name, &handles_.back());
    }
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::vector<double> handles_;
};

}  // namespace

bool is_dotted_word(const std::string& name) {
  bool begins_word = true;
  for (const char c : name) {
    const bool is_inside = is_name_character(c) || c == '.';
    if (begins_word ? !is_name_character(c) || std::isdigit(static_cast<unsigned char>(c)) : !is_inside) return false;
    begins_word = c == '.';
  }
  return !begins_word;
}

const std::vector<std::string>& built_in_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = function_names();
    all.emplace_back("pi");
    return all;
  }();
  return names;
}

FormulaTree parse_formula(const std::string& text, const std::vector<std::string>& variables,
                          const std::vector<std::string>& shown, const std::map<std::string, double>& constants,
                          const std::string& folder) {
  // muParser accepts double quotes only, and it evaluates `c ? a : b` by jumps, which a tree cannot represent.
  std::string quoted = text;
  std::replace(quoted.begin(), quoted.end(), '\'', '"');
  const std::string unquoted = without_quoted(quoted);
  if (unquoted.find('?') != std::string::npos) throw InputError("'?' is not understood; write if(condition, a, b)");

  Building mine{{}, folder};
  const BuildingScope scope(mine);
  mu::Parser parser;
  std::vector<std::string> known = function_names();
  try {
    define_language(parser);
    const Vocabulary vocabulary(parser, mine, variables, shown, constants, names_in(unquoted));
    known = vocabulary.names();
    parser.SetExpr(quoted);
    int results = 0;
    const double* handles = parser.Eval(results);
    if (results != 1)
      throw InputError("expected one value, found several separated by ','; a decimal point is written '.'");
    mine.tree.set_root(index_of(handles[0]));
  } catch (const mu::ParserError& error) {
    throw InputError(explanation(error, as_shown(error.GetToken(), variables, shown), known));
  } catch (const FormulaError& error) {
    throw InputError(error.what());
  }
  return std::move(mine.tree);
}

}  // namespace bielle
