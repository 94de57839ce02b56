//! The graphics adapter and its device.

use std::sync::{Arc, Mutex, PoisonError};

/// Why there is no device to draw with.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// The machine offers no driver.
    #[error(
        "no graphics adapter found: install a Vulkan driver (on Debian or Ubuntu: apt install mesa-vulkan-drivers)"
    )]
    NoAdapter(#[source] wgpu::RequestAdapterError),
    /// The adapter refuses what the renderer needs.
    #[error("the graphics adapter \"{name}\" refuses a device: {source}")]
    NoDevice {
        /// What the driver calls the adapter.
        name: String,
        /// The driver's reason.
        source: wgpu::RequestDeviceError,
    },
}

/// An open graphics device. Cheap to clone: all clones share it.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// What the driver says about the adapter.
    pub info: wgpu::AdapterInfo,
    fault: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// Opens the best adapter without a window, honouring `WGPU_BACKEND`.
    ///
    /// Unless that names one, the first-class backends are asked before OpenGL, whose loaders take longer and
    /// print to standard error.
    ///
    /// # Errors
    /// No adapter, or one that refuses a device.
    pub fn headless() -> Result<Gpu, GpuError> {
        let on = |backends| {
            let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
            descriptor.backends = backends;
            Gpu::open(&wgpu::Instance::new(descriptor), None)
        };
        if let Some(asked) = wgpu::Backends::from_env() {
            return on(asked);
        }
        match on(wgpu::Backends::PRIMARY) {
            Err(GpuError::NoAdapter(_)) => on(wgpu::Backends::all()),
            other => other,
        }
    }

    /// Opens the best adapter of an instance, able to present to the surface if there is one.
    ///
    /// # Errors
    /// No adapter, or one that refuses a device.
    pub fn open(instance: &wgpu::Instance, surface: Option<&wgpu::Surface<'_>>) -> Result<Gpu, GpuError> {
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: surface,
            force_fallback_adapter: false,
            apply_limit_buckets: false,
        };
        let adapter = pollster::block_on(instance.request_adapter(&options)).map_err(GpuError::NoAdapter)?;
        Gpu::of_adapter(&adapter)
    }

    /// Opens a device on an adapter that the caller has chosen.
    ///
    /// # Errors
    /// The adapter refuses a device.
    pub fn of_adapter(adapter: &wgpu::Adapter) -> Result<Gpu, GpuError> {
        let info = adapter.get_info();
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("posewright"),
            required_features: wgpu::Features::empty(),
            required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
            experimental_features: wgpu::ExperimentalFeatures::disabled(),
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            trace: wgpu::Trace::Off,
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|source| GpuError::NoDevice { name: info.name.clone(), source })?;
        Ok(Gpu::of_device(device, queue, info))
    }

    /// Wraps a device that the caller has opened, and takes over its error handler.
    pub fn of_device(device: wgpu::Device, queue: wgpu::Queue, info: wgpu::AdapterInfo) -> Gpu {
        let fault = Arc::new(Mutex::new(None));
        let kept = Arc::clone(&fault);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            log::error!("graphics: {error}");
            kept.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| error.to_string());
        }));
        Gpu { device, queue, info, fault }
    }

    /// Whether pictures are drawn by the processor: then leave out samples and shadows while something moves.
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// The longest edge of a picture, pixels.
    pub fn max_edge(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// The first complaint of the driver since the last call, if any. Every one is also logged.
    pub fn take_fault(&self) -> Option<String> {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}
