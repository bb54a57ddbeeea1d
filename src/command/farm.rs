//! A picture in parts on several machines, by schedulers that exist.

use super::arguments::{Engine, FarmOut};
use super::called::quoted;
use super::error::{Error, Result};
use super::files::Targets;
use super::format::{Format, print_json};
use super::frames::missing_frames;
use super::interrupt::{EndsByItself, interrupted};
use super::own_file::write_file;
use super::parts::merge;
use super::span::told;
use super::streams::Streams;
use super::subject::Subject;
use pinhole::Chapter;
use pinhole::extract::validate;
use pinhole::film::MARK;
use pinhole::plan::Census;
use pinhole::render::{Execution, RenderInProgress};
use pinhole::scene::{opened_files, printable_path};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// The number of jobs in an array that a Slurm allows where nobody has changed it.
const ARRAY: u32 = 1000;
/// How long before its limit a part is asked to stop, in seconds.
const NOTICE: u64 = 60;
/// How often a part that ends early is begun again.
const TRIES: u32 = 5;
/// How often a job that is watched is looked at, and at most how often what there is is merged.
const LOOK: Duration = Duration::from_secs(2);
const MERGE_EVERY: Duration = Duration::from_secs(30);

/// What a job is made of.
struct Job<'a> {
    asked: &'a FarmOut,
    /// This program, as a shell takes it.
    program: String,
    /// The words of the render, as a shell takes them.
    render: String,
    /// Where the picture and the parts go.
    picture: PathBuf,
    threads: u16,
    /// What a machine needs that does not share this one's folders.
    files: Vec<PathBuf>,
}

/// Writes the job of a farm, and runs it where that is asked for.
///
/// Errors: what a render is refused for, before anything is written; a job that failed.
pub fn farm(
    chapters: &[Chapter],
    asked: &FarmOut,
    words: &[OsString],
    format: Format,
    streams: &mut Streams<'_>,
) -> Result {
    let subject = Subject::find(chapters, &asked.chapter)?.set(&asked.options.scene.set)?;
    let overrides = asked.options.asked(false);
    let scene = subject.world(&overrides);
    let placed = |error| subject.placed(error, &overrides);
    validate(&Census::of(&scene)).map_err(|scene_error| placed(scene_error.into()))?;
    // What is not refused here is not refused on a thousand machines; and all files of the scene have been opened.
    RenderInProgress::begin(&Census::of(&scene), &subject.stages(), &Execution::default()).map_err(placed)?;
    let program = std::env::current_exe().unwrap_or_else(|_| "pinhole".into());
    // Before it is looked at what pictures there are.
    let mut files = opened_files();
    files.push(program.clone());
    let targets = Targets::of(&subject, &asked.options)?;
    let Some(picture) = targets.pictures.first() else {
        return Err(Error::CommandLine("a farm's picture is a file, so --output has to name one".into()));
    };
    let threads = asked.options.threads.unwrap_or(1);
    let mut render = render_words(words);
    if asked.options.threads.is_none() {
        render += " -j 1";
    }
    let job =
        Job { asked, program: quoted(&program.to_string_lossy()), render, picture: picture.clone(), threads, files };
    if asked.local {
        return run_here(&job, &program, &subject, streams);
    }
    let mut written = vec![job.write("files", &job.files())?];
    let run = match asked.to {
        Some(Engine::Slurm) => {
            written.push(job.write("sbatch", &job.sbatch())?);
            written.push(job.write("submit.sh", &job.submit())?);
            vec!["sh".to_owned(), written[2].display().to_string()]
        }
        Some(Engine::Openjd) => {
            written.push(job.write("template.json", &job.template()?)?);
            let template = written[1].display().to_string();
            ["openjd", "run", &template, "--step", "merge", "--run-dependencies"].map(String::from).to_vec()
        }
        Some(Engine::Parallel) | None => {
            written.push(job.write("parallel.sh", &job.parallel())?);
            vec!["sh".to_owned(), written[1].display().to_string()]
        }
    };
    let told: Vec<String> = written.iter().map(|file| printable_path(file)).collect();
    let line = run.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
    match format {
        Format::Json => print_json(&serde_json::json!({ "written": told, "begin": line }), streams.out)?,
        Format::Text => writeln!(streams.out, "wrote {}; to begin: {line}", told.join(", "))?,
    }
    if !asked.submit {
        return Ok(());
    }
    match asked.to {
        Some(Engine::Slurm) => watch_slurm(&job, &run, &subject, streams),
        _ => run_and_wait(&run),
    }
}

/// The words of the render among those of this command.
fn render_words(words: &[OsString]) -> String {
    let with_value = ["--parts", "--to", "--limit", "--format"];
    let alone = ["--local", "--submit"];
    let mut kept = Vec::new();
    let mut words = words.iter().map(|word| word.to_string_lossy());
    while let Some(word) = words.next() {
        if with_value.contains(&&*word) {
            words.next();
        } else if !alone.contains(&&*word) && !with_value.iter().any(|own| word.starts_with(&format!("{own}="))) {
            kept.push(word);
        }
    }
    // The first is the name of this command.
    kept.iter().skip(1).map(|word| format!(" {}", quoted(word))).collect()
}

impl Job<'_> {
    fn beside(&self, ending: &str) -> PathBuf {
        self.picture.with_extension(ending)
    }

    fn write(&self, ending: &str, text: &str) -> Result<PathBuf> {
        let file = self.beside(ending);
        write_file(false, &file, text.as_bytes())?;
        Ok(file)
    }

    fn line(&self, part: &str) -> String {
        format!("{} render{} --part {part}/{} --resume", self.program, self.render, self.asked.parts)
    }

    fn merge(&self) -> String {
        format!("{} merge{}", self.program, self.render)
    }

    fn files(&self) -> String {
        let lines: String = self.files.iter().map(|file| format!("{}\n", file.display())).collect();
        format!("# {}: files that must be where a part is rendered\n{lines}", MARK)
    }

    fn sbatch(&self) -> String {
        let seconds = self.asked.limit.as_secs().max(NOTICE + 1);
        let stem = self.picture.file_stem().unwrap_or_default().to_string_lossy();
        let log = quoted(&self.beside("log").display().to_string());
        let (threads, line) = (self.threads, self.line("$PART"));
        format!(
            "#!/bin/sh\n\
             # {mark}\n\
             #SBATCH --job-name=pinhole-{stem}\n\
             #SBATCH --requeue\n\
             #SBATCH --open-mode=append\n\
             #SBATCH --cpus-per-task={threads}\n\
             #SBATCH --time={hours}:{minutes:02}:{seconds:02}\n\
             #SBATCH --signal=B:TERM@{NOTICE}\n\
             #SBATCH --output={log}\n\
             # One part of the picture. A stop in time leaves what there is, and the part is queued again.\n\
             PART=$((${{BEFORE:-0}} + SLURM_ARRAY_TASK_ID))\n\
             trap 'test -n \"$pid\" && kill -TERM $pid' TERM\n\
             {line} &\n\
             pid=$!\n\
             wait $pid\n\
             status=$?\n\
             if [ $status -gt 128 ]; then wait $pid; status=$?; fi\n\
             # 75 is a part that is not done, 130 one that was not begun, other signals may pass. Where RequeueExit=75 is set,\n\
             # Slurm does this too.\n\
             if [ $status -eq 75 ] || [ $status -ge 128 -a \"${{SLURM_RESTART_COUNT:-0}}\" -lt {TRIES} ]; then\n\
             scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\"\n\
             fi\n\
             exit $status\n",
            mark = MARK,
            hours = seconds / 3600,
            minutes = seconds / 60 % 60,
            seconds = seconds % 60,
        )
    }

    fn submit(&self) -> String {
        let (sbatch, parts) = (quoted(&self.beside("sbatch").display().to_string()), self.asked.parts);
        let mut text = format!("#!/bin/sh\n# {}: hands the parts to Slurm, and prints their jobs\nset -e\n", MARK);
        for first in (0..parts).step_by(ARRAY as usize) {
            let count = ARRAY.min(parts - first);
            text += &format!("sbatch --parsable --array=1-{count} --export=ALL,BEFORE={first} {sbatch}\n");
        }
        text
    }

    /// A template of Open Job Description, 2023-09 (github.com/OpenJobDescription/openjd-specifications).
    fn template(&self) -> Result<String> {
        let script = |line: &str| format!("#!/bin/sh\nexec {line}\n");
        let seconds = self.asked.limit.as_secs().max(NOTICE + 1);
        let step = |line: String| {
            serde_json::json!({
                "actions": { "onRun": {
                    "command": "sh", "args": ["{{Task.File.run}}"], "timeout": seconds,
                    "cancelation": { "mode": "NOTIFY_THEN_TERMINATE", "notifyPeriodInSeconds": NOTICE },
                } },
                "embeddedFiles": [{ "name": "run", "type": "TEXT", "data": script(&line) }],
            })
        };
        let stem = self.picture.file_stem().unwrap_or_default().to_string_lossy();
        // Tasks begin in a folder of their own.
        let here = std::env::current_dir().unwrap_or_default();
        let within = |line: String| format!("env -C {} {line}", quoted(&here.display().to_string()));
        let template = serde_json::json!({
            "specificationVersion": "jobtemplate-2023-09",
            "name": format!("pinhole {stem}"),
            "description": MARK,
            "steps": [
                {
                    "name": "parts",
                    "parameterSpace": { "taskParameterDefinitions": [
                        { "name": "Part", "type": "INT", "range": format!("1-{}", self.asked.parts) },
                    ] },
                    "script": step(within(format!("{} --openjd", self.line("{{Task.Param.Part}}")))),
                },
                { "name": "merge", "dependencies": [{ "dependsOn": "parts" }], "script": step(within(self.merge())) },
            ],
        });
        serde_json::to_string_pretty(&template).map_err(|error| Error::usage(error.to_string()))
    }

    fn parallel(&self) -> String {
        let log = quoted(&self.beside("joblog").display().to_string());
        let jobs = (cores() / usize::from(self.threads)).max(1);
        let (mark, parts, line, merge) = (MARK, self.asked.parts, quoted(&self.line("{}")), self.merge());
        format!(
            "#!/bin/sh\n\
             # {mark}: renders the parts by GNU parallel and merges them; what has failed is begun again where it was\n\
             seq {parts} | parallel --will-cite --jobs {jobs} --joblog {log} --resume-failed --retries {TRIES} {line} || exit\n\
             exec {merge}\n"
        )
    }
}

fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

fn run_and_wait(run: &[String]) -> Result {
    let failed = |what: &str| Error::usage(format!("{} {what}", run[0]));
    let status = Command::new(&run[0]).args(&run[1..]).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(failed(&format!("failed: {status}"))),
        Err(error) => Err(failed(&format!("cannot be run: {error}; is it installed?"))),
    }
}

/// Merges the parts of a picture, or says which frames of a film are missing.
fn joined(job: &Job<'_>, subject: &Subject<'_>, streams: &mut Streams<'_>) -> Result {
    match job.asked.options.frames {
        Some(frames) => missing_frames(subject, &job.asked.options, frames, streams),
        None => merge(subject, &job.asked.options, (&[], 0), Format::Text, streams),
    }
}

/// Merges what there is; only what is not merely incomplete is an error.
fn merge_so_far(job: &Job<'_>, subject: &Subject<'_>, streams: &mut Streams<'_>) -> Result<bool> {
    match joined(job, subject, streams) {
        Ok(()) => Ok(true),
        Err(Error::Unfinished(_)) => Ok(false),
        Err(error) => Err(error),
    }
}

/// Hands the job to Slurm, and merges the parts as they arrive until no job is left.
fn watch_slurm(job: &Job<'_>, run: &[String], subject: &Subject<'_>, streams: &mut Streams<'_>) -> Result {
    let failed = |what: String| Error::usage(format!("Slurm: {what}"));
    let submitted = Command::new(&run[0]).args(&run[1..]).stderr(Stdio::inherit()).output();
    let submitted = submitted.map_err(|error| failed(error.to_string()))?;
    if !submitted.status.success() {
        return Err(failed("sbatch refused the job; is Slurm installed here?".into()));
    }
    let ids: Vec<String> = String::from_utf8_lossy(&submitted.stdout)
        .lines()
        .filter_map(|line| Some(line.split(';').next()?.trim().to_owned()))
        .filter(|id| !id.is_empty())
        .collect();
    let ids = ids.join(",");
    streams.note(&format!("Slurm: jobs {ids}; Ctrl-C leaves them running"))?;
    let _by_itself = EndsByItself::begin();
    let mut merged = Instant::now();
    loop {
        thread::sleep(LOOK);
        if interrupted() {
            return Err(pinhole::Error::Interrupted.into());
        }
        let listed = Command::new("squeue").args(["--noheader", "--jobs", &ids]).output();
        let left = listed.map_err(|error| failed(error.to_string()))?;
        let is_over = !left.status.success() || left.stdout.iter().all(u8::is_ascii_whitespace);
        if is_over || merged.elapsed() > MERGE_EVERY {
            // As long as no part is there, there is nothing to merge.
            let complete =
                merge_so_far(job, subject, streams).or_else(|error| if is_over { Err(error) } else { Ok(false) })?;
            merged = Instant::now();
            if is_over {
                let log = printable_path(&job.beside("log"));
                let why = format!("no job is left, and the picture is not complete; {log} says why");
                return if complete { Ok(()) } else { Err(Error::Unfinished(why)) };
            }
        }
    }
}

/// Renders the parts on this machine, each by a process of its own, and merges them.
fn run_here(job: &Job<'_>, program: &Path, subject: &Subject<'_>, streams: &mut Streams<'_>) -> Result {
    let _by_itself = EndsByItself::begin();
    let began = Instant::now();
    let words = shlex::split(&job.render).unwrap_or_default();
    let start = |part: u32| {
        let mut command = Command::new(program);
        command.arg("render").args(&words).args([
            "--part",
            &format!("{part}/{}", job.asked.parts),
            "--resume",
            "--quiet",
        ]);
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().map_err(|error| Error::usage(format!("cannot start part {part}: {error}")))
    };
    let at_once = (cores() / usize::from(job.threads)).max(1);
    let mut waiting: Vec<(u32, u32)> = (1..=job.asked.parts).rev().map(|part| (part, 0)).collect();
    let mut running: Vec<(u32, u32, Child)> = Vec::new();
    let mut failed = Vec::new();
    while !(waiting.is_empty() && running.is_empty()) {
        while running.len() < at_once && !interrupted() {
            let Some((part, tries)) = waiting.pop() else { break };
            running.push((part, tries, start(part)?));
        }
        if interrupted() && running.is_empty() {
            break;
        }
        thread::sleep(Duration::from_millis(10));
        for at in (0..running.len()).rev() {
            let (part, tries, child) = &mut running[at];
            match child.try_wait() {
                Ok(None) => continue,
                Ok(Some(status)) if status.success() => {}
                _ if *tries + 1 < TRIES && !interrupted() => waiting.push((*part, *tries + 1)),
                _ => failed.push(*part),
            }
            running.swap_remove(at);
        }
    }
    if interrupted() {
        let what = "stopped; the parts hold what there is, and the same command continues";
        return Err(Error::Unfinished(what.into()));
    }
    if let Some(part) = failed.first() {
        let line = job.line(&part.to_string());
        return Err(Error::usage(format!("part {part} failed {TRIES} times; this says why: {line}")));
    }
    streams.note(&format!("{} parts in {}", job.asked.parts, told(began.elapsed())))?;
    joined(job, subject, streams)
}
