//! The thread that draws portraits and watches the user's folder, so that the window never waits for either.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use render::Image;
use rig::Figure;

use super::cache::{self, Cache};
use super::entry::{Entry, Stamp};
use super::folder;
use super::portrait::{Opener, Studio};

/// How long a change of the folder may go unnoticed while there is nothing to draw.
const LOOK_EVERY: Duration = Duration::from_secs(2);

/// Which portrait: the pose's path, and which version of its file.
pub type Key = (String, Stamp);

/// A portrait to be drawn.
#[derive(Clone)]
pub struct Job {
    /// Of which pose.
    pub entry: Entry,
    /// Of which figure.
    pub figure: Arc<Figure>,
}

impl Job {
    /// Which portrait.
    pub fn key(&self) -> Key {
        (self.entry.path.clone(), self.entry.stamp)
    }
}

/// Why there is no portrait.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Fault {
    /// The file is at fault: its name, line and column, and why.
    Broken(String),
    /// Nothing can be drawn here, and the cure.
    NoAdapter(String),
}

/// What the thread has to tell.
pub enum News {
    /// A portrait was drawn, or can't be.
    Portrait(Key, Result<Image, Fault>),
    /// The folder has other poses than it had.
    Folder(Vec<Entry>),
}

/// What thread and window share.
#[derive(Default)]
pub struct Desk {
    tasks: Mutex<Tasks>,
    changed: Condvar,
}

#[derive(Default)]
struct Tasks {
    jobs: VecDeque<Job>,
    /// The one that is being drawn.
    current: Option<Key>,
    watched: Option<PathBuf>,
    stop: bool,
}

enum Task {
    Draw(Box<Job>),
    Look(PathBuf),
}

impl Desk {
    fn tasks(&self) -> MutexGuard<'_, Tasks> {
        self.tasks.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Replaces what is to be drawn, first things first; what is being drawn is not asked for again.
    pub fn want(&self, jobs: Vec<Job>) {
        let mut tasks = self.tasks();
        let current = tasks.current.clone();
        tasks.jobs = jobs.into_iter().filter(|job| Some(job.key()) != current).collect();
        if !tasks.jobs.is_empty() {
            self.changed.notify_one();
        }
    }

    /// Watches a folder, or none.
    pub fn watch(&self, folder: Option<PathBuf>) {
        let mut tasks = self.tasks();
        if tasks.watched != folder {
            tasks.watched = folder;
            self.changed.notify_one();
        }
    }

    /// Ends the thread after what it is at.
    pub fn stop(&self) {
        self.tasks().stop = true;
        self.changed.notify_one();
    }

    /// The next thing to do; `None` to end.
    fn next(&self) -> Option<Task> {
        let mut tasks = self.tasks();
        tasks.current = None;
        loop {
            if tasks.stop {
                return None;
            }
            if let Some(job) = tasks.jobs.pop_front() {
                tasks.current = Some(job.key());
                return Some(Task::Draw(Box::new(job)));
            }
            let Some(folder) = tasks.watched.clone() else {
                tasks = self.changed.wait(tasks).unwrap_or_else(PoisonError::into_inner);
                continue;
            };
            let (held, wait) =
                self.changed.wait_timeout(tasks, LOOK_EVERY).unwrap_or_else(PoisonError::into_inner);
            tasks = held;
            if wait.timed_out() {
                return Some(Task::Look(folder));
            }
        }
    }
}

/// What the thread works with.
pub struct Worker {
    /// Where its tasks are.
    pub desk: Arc<Desk>,
    /// Whom it tells.
    pub news: Sender<News>,
    /// Where portraits are kept, if anywhere.
    pub cache: Option<Cache>,
    /// How it opens a device.
    pub opener: Opener,
    /// Whom it wakes when there are news.
    pub ctx: egui::Context,
}

impl Worker {
    /// Works until it is told to stop.
    pub fn run(self) {
        if let Some(cache) = &self.cache {
            cache.prune();
        }
        let mut studio = None;
        let mut of_figure: Option<(Arc<Figure>, u64)> = None;
        let mut seen: Option<Vec<Entry>> = None;
        while let Some(task) = self.desk.next() {
            let news = match task {
                Task::Draw(job) => {
                    let known = of_figure.take().filter(|(figure, _)| Arc::ptr_eq(figure, &job.figure));
                    let number = known.map_or_else(|| cache::figure_key(&job.figure), |(_, number)| number);
                    of_figure = Some((job.figure.clone(), number));
                    News::Portrait(job.key(), self.portrait(&job, number, &mut studio))
                }
                Task::Look(folder) => {
                    let found = folder::scan(&folder);
                    if seen.as_ref() == Some(&found) {
                        continue;
                    }
                    seen = Some(found.clone());
                    News::Folder(found)
                }
            };
            if self.news.send(news).is_err() {
                return;
            }
            self.ctx.request_repaint();
        }
    }

    fn portrait(
        &self,
        job: &Job,
        figure_key: u64,
        studio: &mut Option<Result<Studio, String>>,
    ) -> Result<Image, Fault> {
        let name = job.entry.file_name();
        let text = job.entry.text().map_err(Fault::Broken)?;
        let patch =
            rig::read_pose(&job.figure, &text).map_err(|fault| Fault::Broken(format!("{name}:{fault}")))?;
        let key = cache::key(figure_key, &text);
        if let Some(kept) = self.cache.as_ref().and_then(|cache| cache.get(key)) {
            return Ok(kept);
        }
        let studio = studio.get_or_insert_with(|| Studio::open(self.opener));
        let studio = studio.as_mut().map_err(|cure| Fault::NoAdapter(cure.clone()))?;
        let image = studio.draw(&job.figure, &patch).map_err(Fault::Broken)?;
        if let Some(cache) = &self.cache {
            cache.put(key, &image);
        }
        Ok(image)
    }
}
