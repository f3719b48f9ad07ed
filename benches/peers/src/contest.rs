//! Who is faster: every contestant computes the same quantities of the same robots, in turn.

use std::error::Error;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Instant;

use eigenbody::scalar::Unit;

use crate::Outcome;
use crate::batches::{Batches, FEW, MANY};
use crate::dynibo::Dynibo;
use crate::eigen::{Faer, Nalgebra};
use crate::ours::Ours;
use crate::robot::{self, Robot, Sample};

/// Turns of each contestant.
const ROUNDS: usize = 41;
/// A turn goes over all states again until it took so long (s).
const LONG_ENOUGH: f64 = 2e-3;

/// Computes quantities of one robot.
pub trait Contestant {
    /// What it can compute.
    fn quantities(&self) -> &'static [&'static str];
    /// Computes one of them.
    fn compute(&mut self, quantity: &str, sample: usize, state: &Sample) -> Outcome;
    /// What came out, in eigenbody's order and frames; nothing where the two do not compare.
    fn value(&mut self, quantity: &str) -> Vec<f64>;
    /// Largest difference allowed from eigenbody's numbers, against the largest of them.
    fn tolerance(&self) -> f64 {
        1e-9
    }
    /// All samples, again until it took so many seconds; seconds for each.
    fn turn(&mut self, quantity: &str, samples: &[Sample], seconds: f64) -> Result<f64, Box<dyn Error>> {
        let mut all = || -> Outcome {
            for (k, state) in samples.iter().enumerate() {
                self.compute(quantity, k, state)?;
            }
            Ok(())
        };
        all()?;
        let (start, mut calls) = (Instant::now(), 0);
        while start.elapsed().as_secs_f64() < seconds {
            all()?;
            calls += samples.len();
        }
        Ok(start.elapsed().as_secs_f64() / calls as f64)
    }
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
    quantity: String,
    entrant: usize,
    seconds: Vec<f64>,
}

/// Every quantity that some contestant may know, with the conventions of those that have several.
const QUANTITIES: [&str; 8] =
    ["rnea", "aba", "upper", "crba", "bias", "extremes", "conditioning", "eigenvalues"];
const CONVENTIONS: [&str; 4] = ["", "-local", "-world", "-only"];

/// Times everything, ROUNDS times in turn, and prints medians: `ROBOT QUANTITY CONTESTANT[-CONVENTION]`, seconds a call.
pub fn race(directory: &str, programs: &[&str]) -> Outcome {
    let robots = robot::read(directory)?;
    let mut started = Vec::new();
    for text in programs {
        started.push(Program::start(text, directory, &robots)?);
    }
    let (mut entrants, mut heats) = (Vec::new(), Vec::new());
    for robot in &robots {
        let here: [(&str, Box<dyn Contestant>); 10] = [
            ("eigenbody", Box::new(Ours::new(robot)?)),
            ("dynibo", Box::new(Dynibo::new(robot)?)),
            ("nalgebra", Box::new(Nalgebra::new(robot)?)),
            ("faer", Box::new(Faer::new(robot)?)),
            ("batch", Box::new(Batches::<f64>::new(robot, Unit::Avx512, FEW, 1)?)),
            ("batch-avx2", Box::new(Batches::<f64>::new(robot, Unit::Avx2, FEW, 1)?)),
            ("batch-many", Box::new(Batches::<f64>::new(robot, Unit::Avx512, MANY, 1)?)),
            ("batch-many-2", Box::new(Batches::<f64>::new(robot, Unit::Avx512, MANY, 2)?)),
            ("batch-f32", Box::new(Batches::<f32>::new(robot, Unit::Avx512, FEW, 1)?)),
            ("batch-f32-avx2", Box::new(Batches::<f32>::new(robot, Unit::Avx2, FEW, 1)?)),
        ];
        for (name, mut contestant) in here {
            let entrant = entrants.len();
            for quantity in contestant.quantities() {
                contestant.compute(quantity, 0, &robot.samples[0])?;
                heats.push(Heat::new(robot, name, quantity, entrant));
            }
            entrants.push(Entrant::Here(contestant));
        }
        for (index, program) in started.iter_mut().enumerate() {
            let entrant = entrants.len();
            entrants.push(Entrant::There(index));
            for quantity in QUANTITIES.iter().flat_map(|name| CONVENTIONS.map(|how| format!("{name}{how}"))) {
                if program.ask(&format!("value {} {quantity}", robot.name))?.is_some() {
                    heats.push(Heat::new(robot, &program.name, &quantity, entrant));
                }
            }
        }
    }
    compare(&mut heats, &mut entrants, &mut started)?;
    for round in 1..=ROUNDS {
        eprintln!("race: round {round} of {ROUNDS}");
        for heat in &mut heats {
            let seconds = heat.time(&mut entrants[heat.entrant], &mut started)?;
            heat.seconds.push(seconds);
        }
    }
    for heat in &mut heats {
        heat.seconds.sort_by(f64::total_cmp);
        println!("{}\t{:e}", heat.name(), heat.seconds[ROUNDS / 2]);
    }
    Ok(())
}

impl<'a> Heat<'a> {
    fn new(robot: &'a Robot, contestant: &str, quantity: &str, entrant: usize) -> Self {
        let (contestant, quantity) = (contestant.to_owned(), quantity.to_owned());
        Self { robot, contestant, quantity, entrant, seconds: Vec::new() }
    }

    /// The quantity without the convention.
    fn what(&self) -> &str {
        self.quantity.split('-').next().unwrap_or_default()
    }

    fn name(&self) -> String {
        let convention = &self.quantity[self.what().len()..];
        format!("{} {} {}{convention}", self.robot.name, self.what(), self.contestant)
    }

    fn time(&self, entrant: &mut Entrant<'_>, programs: &mut [Program]) -> Result<f64, Box<dyn Error>> {
        match entrant {
            Entrant::There(index) => {
                let answer = programs[*index].ask(&format!("time {} {}", self.robot.name, self.quantity))?;
                answer.and_then(|numbers| numbers.first().copied()).ok_or_else(|| "no time".into())
            }
            Entrant::Here(contestant) => contestant.turn(&self.quantity, &self.robot.samples, LONG_ENOUGH),
        }
    }

    /// The numbers for the first state.
    fn value(&self, entrant: &mut Entrant<'_>, programs: &mut [Program]) -> Result<Vec<f64>, Box<dyn Error>> {
        match entrant {
            Entrant::There(index) => {
                let answer = programs[*index].ask(&format!("value {} {}", self.robot.name, self.quantity))?;
                Ok(answer.unwrap_or_default())
            }
            Entrant::Here(contestant) => {
                contestant.compute(&self.quantity, 0, &self.robot.samples[0])?;
                Ok(contestant.value(&self.quantity))
            }
        }
    }
}

/// That all compute the same numbers.
fn compare(heats: &mut [Heat<'_>], entrants: &mut [Entrant<'_>], programs: &mut [Program]) -> Outcome {
    let mut values = Vec::new();
    for heat in &*heats {
        values.push(heat.value(&mut entrants[heat.entrant], programs)?);
    }
    for (heat, value) in heats.iter().zip(&values) {
        let same = |other: &Heat<'_>| {
            other.contestant == "eigenbody"
                && (other.what(), &other.robot.name)
                    == (heat.what().replace("entries", "crba").as_str(), &heat.robot.name)
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
