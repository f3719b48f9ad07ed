//! What `simulate` and `track` share: monitors, rows, a progress bar, Ctrl-C, a summary.

use crate::args::RowsArgs;
use crate::failure::Failure;
use crate::growing::Growing;
use crate::interrupt;
use crate::output::{deliver, say};
use eigenbody::{Error, Model, Reduction};
use eigenbody_report::{count, figure};
use eigenbody_study::monitor::{Monitors, Quantity, Spent};
use eigenbody_study::simulate::State;
use eigenbody_study::{Cell, Field, Shape};
use indicatif::{ProgressBar, ProgressStyle};
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Pixels of a PNG for each of its SVG.
const ZOOM: f32 = 2.0;
/// Parts of the progress bar.
const PARTS: u64 = 1000;

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// As it was asked for.
    Whole,
    /// The simulation blew up: the rows before stand.
    BlownUp,
    /// By Ctrl-C: the rows before stand.
    Interrupted,
}

/// The quantities that `--monitor` names; none where the list of all was asked for, which is then printed.
pub fn quantities(args: &RowsArgs) -> Result<Option<Vec<Quantity>>, Failure> {
    let names: Vec<&str> =
        args.monitor.iter().map(|name| name.trim()).filter(|name| !name.is_empty()).collect();
    if names.contains(&"help") {
        deliver(None, |out| {
            for quantity in Quantity::ALL {
                let about = quantity.about();
                writeln!(
                    out,
                    "{}: {}\n    cost   {}\n    error  {}",
                    about.name, about.what, about.cost, about.error
                )?;
            }
            Ok(())
        })?;
        return Ok(None);
    }
    let known = |name: &str| {
        Quantity::named(name).ok_or_else(|| {
            let all: Vec<&str> = Quantity::ALL.iter().map(|quantity| quantity.about().name).collect();
            Failure::Usage(format!("--monitor {name}: no such quantity; known: {}", all.join(", ")))
        })
    };
    let mut found = Vec::new();
    for name in names {
        let quantity = known(name)?;
        if !found.contains(&quantity) {
            found.push(quantity);
        }
    }
    Ok(Some(found))
}

/// Rows on their way out.
pub struct Recorder<'m> {
    monitors: Monitors<'m>,
    growing: Growing,
    fields: Vec<Field>,
    has_velocities: bool,
    /// What is to be drawn: t, and one list a column of numbers that a monitor gives.
    drawn: Option<(Vec<f64>, Vec<Vec<f64>>)>,
    stop: Arc<AtomicBool>,
    bar: ProgressBar,
    title: String,
}

impl<'m> Recorder<'m> {
    /// Opens the output; from now on Ctrl-C stops the run and keeps its rows.
    pub fn new(
        model: &'m Model<f64>,
        name: &str,
        reduction: Reduction,
        quantities: &[Quantity],
        has_velocities: bool,
        args: &RowsArgs,
    ) -> Result<Self, Failure> {
        let numbers = |source: eigenbody::InputError| Failure::Numbers {
            model: name.to_owned(),
            source: source.into(),
        };
        let monitors = Monitors::new(model, reduction, quantities).map_err(numbers)?;
        if monitors.need_velocities() && !has_velocities {
            return Err(Failure::Usage("energy and momentum need velocities, and the log has none".into()));
        }
        if let Some(plot) = &args.plot {
            let kind = plot.extension().and_then(|extension| extension.to_str());
            if !matches!(kind, Some("svg" | "png")) {
                return Err(Failure::Usage(format!("{}: expected a .svg or .png file", plot.display())));
            }
        }
        let mut fields = vec![Field::number("t", "s")];
        for joint in model.joints() {
            for (k, coordinate) in joint.coordinates().enumerate() {
                let unit = match (joint.kind().is_linear(), joint.kind().translations().get(k)) {
                    (true, Some(true)) => "m",
                    (true, _) => "rad",
                    (false, _) => "m, rad, 1",
                };
                fields.push(Field::number(format!("q{coordinate}"), unit));
            }
        }
        if has_velocities {
            let unit = |d| if model.is_translation(d) { "m/s" } else { "rad/s" };
            fields.extend((0..model.nv()).map(|d| Field::number(format!("v{d}"), unit(d))));
        }
        let own = monitors.fields();
        let drawn = args.plot.is_some().then(|| (Vec::new(), vec![Vec::new(); own.len()]));
        fields.extend(own.iter().cloned());
        let dofs: Vec<String> = (0..model.nv()).map(|d| model.dof_name(d)).collect();
        let rows: Vec<String> = reduction.dofs(model).into_iter().map(|d| dofs[d].clone()).collect();
        let metadata = vec![
            ("model", name.to_owned()),
            ("dofs", dofs.join(", ")),
            ("mode_dofs", rows.join(", ")),
            ("software", format!("eigenbody {}", env!("CARGO_PKG_VERSION"))),
        ];
        let growing = Growing::create(args.output.as_deref(), fields, metadata)?;
        let stop = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&stop);
        interrupt::at_first(move || flag.store(true, Ordering::SeqCst));
        let title = name.to_owned();
        Ok(Self { monitors, growing, fields: own, has_velocities, drawn, stop, bar: progress(), title })
    }

    /// True once Ctrl-C was pressed.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::SeqCst)
    }

    /// One row.
    pub fn record(&mut self, state: &State, done: f64) -> Result<(), Failure> {
        let numbers = |source: Error| Failure::Numbers { model: self.title.clone(), source };
        let cells = self.monitors.observe(state).map_err(numbers)?;
        let mut row = vec![Cell::from(state.t)];
        row.extend(state.q.iter().map(|&q| Cell::from(q)));
        if self.has_velocities {
            row.extend(state.v.iter().map(|&v| Cell::from(v)));
        }
        if let Some((times, columns)) = &mut self.drawn {
            times.push(state.t);
            for (column, cell) in columns.iter_mut().zip(&cells) {
                column.push(match cell {
                    Cell::Number(Some(x)) => *x,
                    _ => f64::NAN,
                });
            }
        }
        row.extend(cells);
        self.bar.set_position((done * PARTS as f64) as u64);
        self.growing.push(&row)
    }

    /// The input was bad: nothing is left.
    pub fn discard(self) {
        self.bar.finish_and_clear();
        self.growing.discard();
    }

    /// A line for the user, above the progress bar.
    pub fn say(&self, line: &str) {
        self.bar.suspend(|| say(line));
    }

    /// All rows are there: table and figure under their own names, and what they cost.
    pub fn finish(self, args: &RowsArgs, time: Duration) -> Result<(), Failure> {
        self.bar.finish_and_clear();
        let spent = self.monitors.spent();
        let rows = self.growing.finish()?;
        if let (Some(path), Some((times, columns))) = (&args.plot, &self.drawn) {
            draw(path, &self.title, times, &self.fields, columns)?;
        }
        let name = args.output.as_deref().map_or_else(String::new, |path| format!(": {}", path.display()));
        say(format_args!("{} in {:.2} s{name}", count(rows as usize, "row", "rows"), time.as_secs_f64()));
        let width = spent.iter().map(|spent| spent.what.chars().count()).max().unwrap_or(0);
        for Spent { what, rows, time, factorisations, restarts } in &spent {
            let each = 1e6 * time.as_secs_f64() / (*rows).max(1) as f64;
            let padding = " ".repeat(width - what.chars().count());
            let mut line = format!("  {what}{padding}  {each:8.2} µs a row");
            if let (Some(factorisations), Some(restarts)) = (factorisations, restarts) {
                let lost = count(*restarts as usize, "end", "ends");
                line += &format!(", {factorisations:.3} factorisations a row and end, {lost} found again");
            }
            say(line);
        }
        Ok(())
    }
}

fn draw(
    path: &Path,
    title: &str,
    times: &[f64],
    fields: &[Field],
    columns: &[Vec<f64>],
) -> Result<(), Failure> {
    let series: Vec<figure::Series<'_>> = fields
        .iter()
        .zip(columns)
        .filter(|(field, _)| field.shape == Shape::Number)
        .map(|(field, values)| figure::Series { name: &field.name, unit: &field.unit, values })
        .collect();
    let svg = figure::motion(title, times, &series);
    let bytes = if path.extension().is_some_and(|extension| extension == "png") {
        figure::png(&svg, ZOOM).map_err(|error| Failure::File {
            path: path.to_owned(),
            source: io::Error::other(error.to_string()),
        })?
    } else {
        svg.into_bytes()
    };
    deliver(Some(path), |out| out.write_all(&bytes))
}

/// A bar on standard error, if a person looks at it.
fn progress() -> ProgressBar {
    let bar = ProgressBar::new(PARTS);
    if let Ok(style) = ProgressStyle::with_template("{elapsed_precise} [{bar:40}] {percent:>3}%") {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}
