//! The main figures of a run as a table of docs/outputs.md, from their catalogue.

use std::ptr;

use gearwear::results::figures::{self, FAMILIES, FigureFamily, FigureValues, MainFigure, RexsAttribute};

/// A row for each family of figures.
pub fn of_catalogue() -> String {
    let mut text = String::from(
        "\nIn names, `{gear}` is `pinion` or `wheel` and `{state}` is `new` or `worn`; the error is that of `summary.json`, REXS names the attribute that `gearwear rexs` writes.\n\n\
         | figure | unit | holds | over the face width | error | shown in | REXS |\n|---|---|---|---|---|---|---|\n",
    );
    for family in FAMILIES {
        text.push_str(&format!(
            "| `{}` | {} | {} | {} | {} | {} | {} |\n",
            family.path,
            if family.unit.is_empty() { "–" } else { family.unit },
            meaning(family),
            family.over_slices.name(),
            error(family),
            shown_in(family),
            attribute(family)
        ));
    }
    text.push('\n');
    text
}

fn meaning(family: &FigureFamily) -> String {
    format!("{}: {}", family.row(), family.meaning.replace(", {state}", "").replace("{gear}", "gear"))
}

fn error(family: &FigureFamily) -> String {
    match (family.errors, &family.values) {
        (["", ""], _) => "–".to_owned(),
        ([one, other], FigureValues::Pair(_)) => format!("the greater of `{one}` and `{other}`"),
        (["", worn], _) => format!("`{worn}`, worn"),
        ([one, _], FigureValues::Gears(_)) => format!("`{}`", one.replace("pinion", "{gear}")),
        ([one, _], FigureValues::States(_)) => format!("`{}`", one.replace("new", "{state}")),
    }
}

fn shown_in(family: &FigureFamily) -> String {
    let is_among = |figures: &[&MainFigure]| figures.iter().any(|figure| ptr::eq(figure.family, family));
    let places = [
        ("terminal", family.in_terminal),
        ("page", family.on_page),
        ("sweep", is_among(figures::in_sweeps())),
        ("compare", is_among(figures::compared())),
        ("uncertainty", is_among(figures::default_outputs())),
    ];
    let named: Vec<&str> = places.iter().filter(|(_, is_shown)| *is_shown).map(|(name, _)| *name).collect();
    if named.is_empty() { "–".to_owned() } else { named.join(", ") }
}

fn attribute(family: &FigureFamily) -> String {
    match family.rexs {
        None => "–".to_owned(),
        Some(RexsAttribute::Own(name)) => format!("`custom_gearwear_{name}`"),
        Some(RexsAttribute::Database { ids, .. }) => {
            ids.iter().map(|id| format!("`{}`", id.id)).collect::<Vec<_>>().join(", ")
        }
    }
}
