//! Work that Python watches: the interpreter is free meanwhile, progress is told, and Ctrl-C ends with the best so far.

use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use peenpose::control::{Clock, Control, Progress};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// How long Ctrl-C may go unnoticed.
const LOOK: Duration = Duration::from_millis(50);

/// Does a job with so many threads, all cores by default.
pub fn watched<T: Send>(
    py: Python<'_>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
    job: impl FnOnce(&Control) -> T + Send,
) -> PyResult<T> {
    let pool = threads
        .map(|threads| {
            let builder = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = builder.build();
            pool.map_err(|error| {
                PyRuntimeError::new_err(format!("cannot start {threads} threads: {error}"))
            })
        })
        .transpose()?;
    if threads == Some(0) {
        return Err(PyValueError::new_err("threads: expected at least 1"));
    }
    let (sender, receiver) = channel();
    let sender = Mutex::new(sender);
    let started = Instant::now();
    let control = Control {
        clock: Clock::new(move || started.elapsed().as_secs_f64()),
        observer: progress.is_some().then(|| -> peenpose::control::Observer {
            std::sync::Arc::new(move |progress| {
                if let Ok(sender) = sender.lock() {
                    // Nobody listens any more once the job is done.
                    let _ = sender.send(progress);
                }
            })
        }),
        ..Control::default()
    };
    let (pool, control, progress) = (&pool, &control, &progress);
    let run = move || match pool {
        Some(pool) => pool.install(|| job(control)),
        None => job(control),
    };
    py.detach(move || {
        thread::scope(|scope| {
            let worker = scope.spawn(run);
            let mut failed = None;
            while !worker.is_finished() {
                let news = match receiver.recv_timeout(LOOK) {
                    Ok(news) => Some(news),
                    Err(RecvTimeoutError::Timeout) => None,
                    Err(RecvTimeoutError::Disconnected) => {
                        thread::sleep(Duration::from_millis(1));
                        None
                    }
                };
                Python::attach(|py| {
                    // Ctrl-C asks for the best so far; asked twice, for it at once.
                    if py.check_signals().is_err() {
                        match control.cancel.is_set() {
                            false => control.cancel.end(),
                            true => control.cancel.hurry(),
                        }
                    }
                    if let (Some(news), Some(progress), None) = (news, progress, &failed)
                        && let Err(error) = tell(py, progress, news)
                    {
                        control.cancel.end();
                        control.cancel.hurry();
                        failed = Some(error);
                    }
                });
            }
            let done = worker.join();
            match (failed, done) {
                (Some(error), _) => Err(error),
                (None, Ok(done)) => Ok(done),
                (None, Err(_)) => Err(PyRuntimeError::new_err(
                    "a fault of peenpose itself; please report it",
                )),
            }
        })
    })
}

/// Calls `progress(poses, best)` or `progress(step, of)`.
fn tell(py: Python<'_>, progress: &Py<PyAny>, news: Progress) -> PyResult<()> {
    match news {
        Progress::Search { poses, best } => progress.call1(py, ("search", poses, best)),
        Progress::Step { name, number, of } => progress.call1(py, (name, number, of)),
    }
    .map(drop)
}
