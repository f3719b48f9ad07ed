//! Who is faster: every contestant computes the same quantities of the same robots, in turn.

use std::error::Error;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Instant;

use eigenbody::scalar::Unit;

use crate::Outcome;
use crate::batches::{Apart, Batches, FEW, MANY, Zeros};
use crate::dynibo::Dynibo;
use crate::eigen::{Faer, Nalgebra};
use crate::ours::Ours;
use crate::quantity::Quantity;
use crate::robot::{self, Robot, Sample};

/// Turns of each contestant.
const ROUNDS: usize = 41;
/// A turn goes over all states again until it took so long (s).
const LONG_ENOUGH: f64 = 2e-3;

/// Computes quantities of one robot.
pub trait Contestant {
    /// What it can compute.
    fn quantities(&self) -> &'static [Quantity];
    /// Computes one of them.
    fn compute(&mut self, quantity: Quantity, sample: usize, state: &Sample) -> Outcome;
    /// What came out, in eigenbody's order and frames; nothing where the two do not compare.
    fn value(&mut self, quantity: Quantity) -> Vec<f64>;
    /// Largest difference allowed from eigenbody's numbers, against the largest of them.
    fn tolerance(&self) -> f64 {
        1e-9
    }
    /// All samples, again until it took so many seconds, after half as long for memory to come near and the processor to wake; seconds for
    /// each.
    fn turn(&mut self, quantity: Quantity, samples: &[Sample], seconds: f64) -> Result<f64, Box<dyn Error>> {
        let mut all =
            || samples.iter().enumerate().try_for_each(|(k, state)| self.compute(quantity, k, state));
        repeated(seconds / 2.0, &mut all)?;
        Ok(repeated(seconds, &mut all)? / samples.len() as f64)
    }
}

/// Calls it until that took so many seconds; seconds a call.
pub fn repeated<E>(at_least: f64, mut call: impl FnMut() -> Result<(), E>) -> Result<f64, E> {
    let (start, mut calls) = (Instant::now(), 0);
    while start.elapsed().as_secs_f64() < at_least {
        call()?;
        calls += 1;
    }
    Ok(start.elapsed().as_secs_f64() / f64::from(calls))
}

/// A contestant on a robot, here or in a program of its own.
enum Entrant<'a> {
    Here(Box<dyn Contestant + 'a>),
    There(usize),
}

/// A program that answers questions about all robots, line by line.
struct Program {
    name: String,
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl Program {
    /// `NAME=PATH[,ARGUMENT..]`, called with the robots' files.
    fn start(text: &str, directory: &str, robots: &[Robot]) -> Result<Self, Box<dyn Error>> {
        let (name, call) = text.split_once('=').ok_or_else(|| format!("`{text}`: no NAME="))?;
        let mut words = call.split(',');
        let mut command = Command::new(words.next().unwrap_or_default());
        command.args(words).args(robots.iter().map(|robot| format!("{directory}/{}.robot", robot.name)));
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        let input = child.stdin.take().ok_or("no way in")?;
        let output = BufReader::new(child.stdout.take().ok_or("no way out")?);
        Ok(Self { name: name.to_owned(), child, input, output })
    }

    /// The numbers of the answer; nothing if it does not compute that.
    fn ask(&mut self, question: &str) -> Result<Option<Vec<f64>>, Box<dyn Error>> {
        writeln!(self.input, "{question}")?;
        self.input.flush()?;
        let mut line = String::new();
        if self.output.read_line(&mut line)? == 0 {
            return Err(format!("{} ended", self.name).into());
        }
        if line.trim() == "none" {
            return Ok(None);
        }
        Ok(Some(line.split_whitespace().map(str::parse).collect::<Result<_, _>>()?))
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// One thing to time.
struct Heat<'a> {
    robot: &'a Robot,
    contestant: String,
    quantity: Quantity,
    /// Of a program that computes it in several ways.
    convention: &'static str,
    entrant: usize,
}

/// Conventions of programs that have several.
const CONVENTIONS: [&str; 4] = ["", "-local", "-world", "-only"];

/// Times everything, ROUNDS times in turn, and prints all of it: `ROBOT QUANTITY CONTESTANT[-CONVENTION]`, seconds a call.
pub fn race(directory: &str, programs: &[&str]) -> Outcome {
    let robots = robot::read(directory)?;
    let mut started = Vec::new();
    for text in programs {
        started.push(Program::start(text, directory, &robots)?);
    }
    let (mut entrants, mut heats) = (Vec::new(), Vec::new());
    for robot in &robots {
        let here: [(&str, Box<dyn Contestant>); 12] = [
            ("eigenbody", Box::new(Ours::new(robot)?)),
            ("dynibo", Box::new(Dynibo::new(robot)?)),
            ("nalgebra", Box::new(Nalgebra::new(robot)?)),
            ("faer", Box::new(Faer::new(robot)?)),
            ("batch", Box::new(Batches::new(robot, &robot.model, Unit::Avx512, FEW, 1)?)),
            ("batch-avx2", Box::new(Batches::new(robot, &robot.model, Unit::Avx2, FEW, 1)?)),
            ("batch-many", Box::new(Batches::new(robot, &robot.model, Unit::Avx512, MANY, 1)?)),
            ("batch-many-2", Box::new(Batches::new(robot, &robot.model, Unit::Avx512, MANY, 2)?)),
            ("batch-many-apart", Box::new(Apart::new(robot, MANY)?)),
            ("batch-zeros", Box::new(Zeros::new(robot)?)),
            ("batch-f32", Box::new(Batches::new(robot, &robot.single, Unit::Avx512, FEW, 1)?)),
            ("batch-f32-avx2", Box::new(Batches::new(robot, &robot.single, Unit::Avx2, FEW, 1)?)),
        ];
        for (name, mut contestant) in here {
            let entrant = entrants.len();
            for &quantity in contestant.quantities() {
                contestant.compute(quantity, 0, &robot.samples[0])?;
                heats.push(Heat { robot, contestant: name.to_owned(), quantity, convention: "", entrant });
            }
            entrants.push(Entrant::Here(contestant));
        }
        for (index, program) in started.iter_mut().enumerate() {
            let entrant = entrants.len();
            entrants.push(Entrant::There(index));
            for (quantity, convention) in
                Quantity::ALL.iter().flat_map(|&what| CONVENTIONS.map(|how| (what, how)))
            {
                let heat = Heat { robot, contestant: program.name.clone(), quantity, convention, entrant };
                if program.ask(&heat.question("value"))?.is_some() {
                    heats.push(heat);
                }
            }
        }
    }
    compare(&heats, &mut entrants, &mut started)?;
    for round in 1..=ROUNDS {
        eprintln!("race: round {round} of {ROUNDS}");
        // Whoever comes after another has what that left: memory, a second core awake. Every other round goes backwards.
        let (forwards, backwards) = heats.split_at(if round % 2 == 1 { heats.len() } else { 0 });
        for heat in forwards.iter().chain(backwards.iter().rev()) {
            let seconds = heat.time(&mut entrants[heat.entrant], &mut started)?;
            println!("{}\t{seconds:e}", heat.name());
        }
    }
    Ok(())
}

impl Heat<'_> {
    fn name(&self) -> String {
        format!("{} {} {}{}", self.robot.name, self.quantity.name(), self.contestant, self.convention)
    }

    /// To a program: `time` or `value`.
    fn question(&self, of: &str) -> String {
        format!("{of} {} {}{}", self.robot.name, self.quantity.name(), self.convention)
    }

    fn time(&self, entrant: &mut Entrant<'_>, programs: &mut [Program]) -> Result<f64, Box<dyn Error>> {
        match entrant {
            Entrant::There(index) => {
                let answer = programs[*index].ask(&self.question("time"))?;
                answer.and_then(|numbers| numbers.first().copied()).ok_or_else(|| "no time".into())
            }
            Entrant::Here(contestant) => contestant.turn(self.quantity, &self.robot.samples, LONG_ENOUGH),
        }
    }

    /// The numbers for the first state.
    fn value(&self, entrant: &mut Entrant<'_>, programs: &mut [Program]) -> Result<Vec<f64>, Box<dyn Error>> {
        match entrant {
            Entrant::There(index) => {
                let answer = programs[*index].ask(&self.question("value"))?;
                Ok(answer.unwrap_or_default())
            }
            Entrant::Here(contestant) => {
                contestant.compute(self.quantity, 0, &self.robot.samples[0])?;
                Ok(contestant.value(self.quantity))
            }
        }
    }
}

/// That all compute the same numbers.
fn compare(heats: &[Heat<'_>], entrants: &mut [Entrant<'_>], programs: &mut [Program]) -> Outcome {
    let mut values = Vec::new();
    for heat in heats {
        values.push(heat.value(&mut entrants[heat.entrant], programs)?);
    }
    for (heat, value) in heats.iter().zip(&values) {
        let same = |other: &Heat<'_>| {
            other.contestant == "eigenbody"
                && (other.quantity, &other.robot.name) == (heat.quantity.one_by_one(), &heat.robot.name)
        };
        let Some(ours) = heats.iter().position(same).map(|index| &values[index]) else { continue };
        if value.is_empty() || ours.is_empty() {
            continue;
        }
        let largest = ours.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let worst = value.iter().zip(ours).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        let tolerance = match &entrants[heat.entrant] {
            Entrant::Here(contestant) => contestant.tolerance(),
            Entrant::There(_) => 1e-9,
        };
        if value.len() != ours.len() || worst.is_nan() || worst > tolerance * largest {
            return Err(format!("{}: {worst:e} off, of {largest:e}", heat.name()).into());
        }
    }
    Ok(())
}
