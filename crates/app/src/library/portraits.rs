//! The portraits that the window has, and those that it waits for.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::thread::JoinHandle;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};
use render::Image;
use rig::Figure;

use super::cache::Cache;
use super::entry::{Entry, Stamp};
use super::portrait::Opener;
use super::worker::{Desk, Fault, Job, Key, News, Worker};

/// As many portraits are kept in memory, some hundreds of kilobytes each; the longest unseen go first.
pub const MOST: usize = 320;

/// What there is to show of a pose.
#[derive(Clone)]
pub enum Portrait {
    /// Its picture.
    Drawn(TextureHandle),
    /// Its file is at fault: what, with line and column.
    Broken(String),
}

struct Made {
    /// Of which version of the file.
    stamp: Stamp,
    portrait: Portrait,
    /// The frame in which it was last shown.
    seen: u64,
}

/// The portraits of a library.
pub struct Portraits {
    desk: Arc<Desk>,
    thread: Option<JoinHandle<()>>,
    news: Option<Receiver<News>>,
    figure: Option<Arc<Figure>>,
    /// By the pose's path.
    made: HashMap<String, Made>,
    frame: u64,
    opener: Opener,
    cache: Option<Cache>,
    /// Why nothing can be drawn here.
    pub no_adapter: Option<String>,
}

impl Portraits {
    /// None yet; the thread that draws them is started by the first that is wanted.
    pub fn new(opener: Opener, cache: Option<Cache>) -> Portraits {
        Portraits {
            desk: Arc::default(),
            thread: None,
            news: None,
            figure: None,
            made: HashMap::new(),
            frame: 0,
            opener,
            cache,
            no_adapter: None,
        }
    }

    /// What came from the thread: portraits are taken in here, a changed folder is handed on. Portraits are
    /// those of the figure given last.
    pub fn receive(&mut self, ctx: &Context, figure: Option<&Arc<Figure>>) -> Option<Vec<Entry>> {
        self.frame += 1;
        let same =
            |figure: &Arc<Figure>| self.figure.as_ref().is_some_and(|former| Arc::ptr_eq(former, figure));
        if let Some(figure) = figure.filter(|figure| !same(figure)) {
            self.made.clear();
            self.figure = Some(figure.clone());
        }
        let mut folder = None;
        let news: Vec<News> = self.news.iter().flat_map(|news| news.try_iter()).collect();
        for item in news {
            match item {
                News::Folder(entries) => folder = Some(entries),
                News::Portrait(key, Ok(image)) => {
                    let texture = ctx.load_texture(&key.0, color_image(&image), TextureOptions::LINEAR);
                    self.keep(key, Portrait::Drawn(texture));
                }
                News::Portrait(key, Err(Fault::Broken(why))) => self.keep(key, Portrait::Broken(why)),
                News::Portrait(_, Err(Fault::NoAdapter(cure))) => self.no_adapter = Some(cure),
            }
        }
        folder
    }

    fn keep(&mut self, (path, stamp): Key, portrait: Portrait) {
        self.made.insert(path, Made { stamp, portrait, seen: self.frame });
    }

    /// The portrait of a pose, if there is one. It counts as seen.
    ///
    /// Of a file that has changed it is the former one until the new one is drawn.
    pub fn of(&mut self, entry: &Entry) -> Option<Portrait> {
        let made = self.made.get_mut(&entry.path)?;
        made.seen = self.frame;
        Some(made.portrait.clone())
    }

    fn has(&self, entry: &Entry) -> bool {
        self.made.get(&entry.path).is_some_and(|made| made.stamp == entry.stamp)
    }

    /// How many of these poses have been seen to.
    pub fn count(&self, entries: &[&Entry]) -> usize {
        entries.iter().filter(|entry| self.has(entry)).count()
    }

    /// Asks for the portraits of these poses that aren't there, in this order; none at all while `busy`.
    pub fn want<'a>(&mut self, ctx: &Context, entries: impl Iterator<Item = &'a Entry>, busy: bool) {
        let Some(figure) = self.figure.clone() else { return };
        let missing = entries
            .filter(|entry| !self.has(entry))
            .map(|entry| Job { entry: entry.clone(), figure: figure.clone() });
        let still = busy || self.no_adapter.is_some();
        let jobs: Vec<Job> = if still { Vec::new() } else { missing.take(MOST).collect() };
        if !jobs.is_empty() {
            self.start(ctx);
        }
        self.desk.want(jobs);
        self.forget_unseen();
    }

    /// Watches a folder for changes, or none.
    pub fn watch(&mut self, ctx: &Context, folder: Option<std::path::PathBuf>) {
        if folder.is_some() {
            self.start(ctx);
        }
        self.desk.watch(folder);
    }

    /// Nothing more is drawn or watched for now.
    pub fn rest(&mut self) {
        if self.thread.is_some() {
            self.desk.want(Vec::new());
            self.desk.watch(None);
        }
    }

    fn start(&mut self, ctx: &Context) {
        if self.thread.is_some() {
            return;
        }
        let (news, received) = channel();
        let worker = Worker {
            desk: self.desk.clone(),
            news,
            cache: self.cache.clone(),
            opener: self.opener,
            ctx: ctx.clone(),
        };
        self.news = Some(received);
        self.thread = Some(std::thread::spawn(move || worker.run()));
    }

    fn forget_unseen(&mut self) {
        if self.made.len() <= MOST {
            return;
        }
        let mut seen: Vec<(u64, String)> =
            self.made.iter().map(|(path, made)| (made.seen, path.clone())).collect();
        seen.sort();
        for (_, path) in &seen[..self.made.len() - MOST] {
            self.made.remove(path);
        }
    }
}

impl Drop for Portraits {
    fn drop(&mut self) {
        self.desk.stop();
        if let Some(thread) = self.thread.take() {
            // A device is closed before the program ends; at most one portrait is waited for.
            let _ = thread.join();
        }
    }
}

fn color_image(image: &Image) -> ColorImage {
    ColorImage::from_rgba_unmultiplied([image.width as usize, image.height as usize], &image.rgba)
}
